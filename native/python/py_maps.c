#include "python/door.h"

PyMethodDef dp_py_maps_methods[] = {{NULL, NULL, 0, NULL}};

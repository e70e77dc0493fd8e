#include "python/door.h"

PyMethodDef dp_py_soil_methods[] = {{NULL, NULL, 0, NULL}};

#include "python/door.h"

PyMethodDef dp_py_terrain_methods[] = {{NULL, NULL, 0, NULL}};

#include "python/door.h"

PyMethodDef dp_py_walker_methods[] = {{NULL, NULL, 0, NULL}};

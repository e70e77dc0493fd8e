#include "python/door.h"

PyMethodDef dp_py_imprint_methods[] = {{NULL, NULL, 0, NULL}};

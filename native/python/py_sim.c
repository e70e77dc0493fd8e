#include "python/door.h"

int dp_py_sim_types(PyObject* module)
{
    (void)module;
    return 0;
}

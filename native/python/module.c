// python/module.c - desire_path._native: a table of contents. Everything is in py_<room>.c.
#include "python/buffers.h"
#include "sim/sim.h"

static int fill(PyObject* module)
{
    PyMethodDef* const tables[] = {
        dp_py_walker_methods, dp_py_imprint_methods, dp_py_soil_methods, dp_py_kind_methods,
        dp_py_plants_methods, dp_py_terrain_methods, dp_py_maps_methods, dp_py_refine_methods,
        dp_py_paths_methods,  dp_py_base_methods,    dp_py_spray_methods};
    for (size_t t = 0; t < sizeof tables / sizeof *tables; ++t)
        if (PyModule_AddFunctions(module, tables[t]) < 0) return -1;
    int (*const types[])(PyObject*) = {dp_py_block_type, dp_py_sim_type, dp_py_film_type};
    for (size_t t = 0; t < sizeof types / sizeof *types; ++t)
        if (types[t](module) < 0) return -1;
    const struct
    {
        const char* name;
        long        value;
    } sizes[] = {{"TILE", DP_TILE}, {"PAGE", DP_PAGE}, {"PAGE_EDGE", DP_PAGE_EDGE}};
    for (size_t t = 0; t < sizeof sizes / sizeof *sizes; ++t)
        if (PyModule_AddIntConstant(module, sizes[t].name, sizes[t].value) < 0) return -1;
    return 0;
}

static PyModuleDef_Slot slots[] = {{Py_mod_exec, (void*)fill}, {0, NULL}};

static PyModuleDef definition = {
    .m_base = PyModuleDef_HEAD_INIT,
    .m_name = "desire_path._native",
    .m_doc = "The core of Desire Path: what a walking body does to the ground.",
    .m_size = 0,
    .m_slots = slots,
};

PyMODINIT_FUNC PyInit__native(void)
{
    return PyModuleDef_Init(&definition);
}

// python/py_frames.c - desire_path._native.Film: frames for playback and maps of a rectangle of tiles
// of a simulation, written in the background while the ground goes on.
#include "base/alloc.h"
#include "python/py_sim.h"

enum
{
    TRAIL = 0,
    LEAN = 1,  // on planted ground only
    MAPS = 2,
    FILMS = 3
};

typedef struct Film
{
    PyObject_HEAD
    Simulation* simulation;   // held
    DpFilm*     film[FILMS];  // NULL: not opened
    long        tile_x, tile_y;
    int         tiles_x, tiles_y;
} Film;

static void film_dealloc(PyObject* object)
{
    Film*         self = (Film*)object;
    PyTypeObject* type = Py_TYPE(object);
    for (int k = 0; k < FILMS; ++k) dp_film_close(self->film[k]);
    Py_XDECREF((PyObject*)self->simulation);
    freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    release(object);
    Py_DECREF(type);
}

static DpFilmOptions options_of(const Film* self, const DpNote* notes, int note_count)
{
    return (DpFilmOptions){.tile_x = self->tile_x,
                           .tile_y = self->tile_y,
                           .tiles_x = self->tiles_x,
                           .tiles_y = self->tiles_y,
                           .notes = notes,
                           .note_count = note_count};
}

// ---- writing -----------------------------------------------------------------------------------

static PyObject* told(DpStatus status, const char* path)
{
    return dp_door_result(status, *path ? path : "encoding a frame");
}

static PyObject* write_file(Film* self, int which, const char* path, double time)
{
    const char* failed = "";
    if (!self->film[which]) {
        PyErr_SetString(PyExc_ValueError, "writing what is not open");
        return NULL;
    }
    if (!dp_py_enter(self->simulation)) return NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_film_write(self->film[which], path, time, &failed);
    Py_END_ALLOW_THREADS
    self->simulation->busy = false;
    return told(status, failed);
}

static PyObject* film_write_frame(PyObject* object, PyObject* args)
{
    const char* path;  // None: take the changes in, write nothing
    double      time;
    int         lean = 0;
    if (!PyArg_ParseTuple(args, "zd|p:write_frame", &path, &time, &lean)) return NULL;
    return write_file((Film*)object, lean ? LEAN : TRAIL, path, time);
}

static PyObject* film_write_maps(PyObject* object, PyObject* args)
{
    const char* path;
    double      time;
    if (!PyArg_ParseTuple(args, "sd:write_maps", &path, &time)) return NULL;
    return write_file((Film*)object, MAPS, path, time);
}

static PyObject* film_list_files(PyObject* object, PyObject* args)
{
    Film*       self = (Film*)object;
    const char* path;
    if (!PyArg_ParseTuple(args, "s:list_files", &path) || !dp_py_enter(self->simulation))
        return NULL;
    DpStatus status = DP_OK;
    Py_BEGIN_ALLOW_THREADS
    for (int which = TRAIL; which <= LEAN && status == DP_OK; ++which)
        if (self->film[which]) status = dp_film_list(self->film[which], path);
    Py_END_ALLOW_THREADS
    self->simulation->busy = false;
    return told(status, path);
}

PyObject* dp_py_flush(PyObject* object, PyObject* unused)
{
    Simulation* self = (Simulation*)object;
    const char* failed = "";
    DpStatus    status = DP_OK;
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    if (self->reel) status = dp_reel_told(self->reel, true, &failed);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return told(status, failed);
}

// ---- opening -----------------------------------------------------------------------------------

// A film for playback, with what its channels hold.
static DpStatus open_playback(Film* self, bool lean, const char* software)
{
    static const char* const channel[4] = {"R", "G", "B", "A"};
    static const int         trail_field[4] = {DP_FIELD_HEIGHT_CHANGE, DP_FIELD_PLANT_STRENGTH,
                                               DP_FIELD_COMPRESSION, DP_FIELD_PRESSURE_TIME};
    static const int         lean_field[4] = {DP_FIELD_LEAN, DP_FIELD_LEAN + 1, DP_FIELD_LEAN + 2,
                                              DP_FIELD_PLANT_STRENGTH};
    static const char* const trail_names[4] = {"height change [m]", "plant strength [-]",
                                               "compression [m]", "pressure_time [Pa s]"};
    static const char* const lean_names[4] = {"lean_x [-]", "lean_y [-]", "crushed [-]",
                                              "plant strength [-]"};
    const char* const*       names = lean ? lean_names : trail_names;
    const DpTerrain*         terrain = self->simulation->terrain;
    double                   origin[2];
    dp_terrain_origin(terrain, origin);
    const double cell = dp_terrain_cell(terrain);
    const DpNote notes[] = {
        {"software", software, 0.0},
        {"cell", NULL, cell},
        {"originX", NULL, origin[0] + cell * DP_TILE * (double)self->tile_x},
        {"originY", NULL, origin[1] + cell * DP_TILE * (double)self->tile_y},
        {"channelR", names[0], 0.0},
        {"channelG", names[1], 0.0},
        {"channelB", names[2], 0.0},
        {"channelA", names[3], 0.0},
    };
    DpFilmOptions options = options_of(self, notes, (int)(sizeof notes / sizeof *notes));
    options.fields = 4;
    for (int f = 0; f < 4; ++f) {
        options.field[f] = (lean ? lean_field : trail_field)[f];
        options.channel[f] = channel[f];
    }
    return dp_film_open(self->simulation->reel, &options, &self->film[lean ? LEAN : TRAIL]);
}

// An empty Film of a simulation, or NULL with an exception.
static Film* make_film(Simulation* simulation)
{
    PyObject* module = PyType_GetModule(Py_TYPE((PyObject*)simulation));
    PyObject* type = module ? PyObject_GetAttrString(module, "Film") : NULL;
    if (!type) return NULL;
    allocfunc allocate = (allocfunc)PyType_GetSlot((PyTypeObject*)type, Py_tp_alloc);
    Film*     film = (Film*)allocate((PyTypeObject*)type, 0);
    Py_DECREF(type);
    if (film) film->simulation = (Simulation*)Py_NewRef((PyObject*)simulation);
    return film;
}

PyObject* dp_py_open_frames(PyObject* object, PyObject* args)
{
    Simulation* simulation = (Simulation*)object;
    long        tx, ty;
    int         nx, ny;
    const char* software;
    if (!PyArg_ParseTuple(args, "lliis:open_frames", &tx, &ty, &nx, &ny, &software)) return NULL;
    Film* self = make_film(simulation);
    if (!self) return NULL;
    if (!dp_py_enter(simulation)) {
        Py_DECREF((PyObject*)self);
        return NULL;
    }
    self->tile_x = tx, self->tile_y = ty;
    self->tiles_x = nx, self->tiles_y = ny;
    DpStatus status = DP_OK;
    Py_BEGIN_ALLOW_THREADS
    if (!simulation->reel)
        status = dp_reel_create(&simulation->reel, simulation->sim, simulation->workers);
    if (status == DP_OK) status = open_playback(self, false, software);
    if (status == DP_OK && simulation->plants) status = open_playback(self, true, software);
    Py_END_ALLOW_THREADS
    simulation->busy = false;
    if (status == DP_OK) return (PyObject*)self;
    Py_DECREF((PyObject*)self);
    return dp_door_result(status, "opening the frames");
}

// Channel names and fields from a tuple of (name, number of the field); 0, or -1 with an exception.
static int read_fields(const Film* self, PyObject* items, DpFilmOptions* options)
{
    const Py_ssize_t count = PyTuple_Size(items);
    const int        last = self->simulation->plants ? DP_FIELD_LEAN + 2 : DP_FIELD_HEIGHT_CHANGE;
    if (count < 1 || count > DP_FILM_FIELDS) {
        PyErr_Format(PyExc_ValueError, "open_maps: expected 1 to %d fields", DP_FILM_FIELDS);
        return -1;
    }
    options->fields = (int)count;
    for (Py_ssize_t k = 0; k < count; ++k) {
        int*      field = &options->field[k];
        PyObject* item = PyTuple_GetItem(items, k);
        if (!PyTuple_Check(item)) {
            PyErr_SetString(PyExc_TypeError, "open_maps: expected tuples (name, field)");
            return -1;
        }
        if (!PyArg_ParseTuple(item, "si:open_maps", &options->channel[k], field)) return -1;
        if (*field != DP_FIELD_PRESSURE &&
            (*field < 0 || *field > last ||
             (*field > DP_FIELD_HEIGHT_CHANGE && *field < DP_FIELD_LEAN))) {
            PyErr_Format(PyExc_ValueError, "open_maps: there is no field %d", *field);
            return -1;
        }
    }
    return 0;
}

static PyObject* film_open_maps(PyObject* object, PyObject* args)
{
    Film*     self = (Film*)object;
    PyObject *fields, *items;
    if (!PyArg_ParseTuple(args, "O!O!:open_maps", &PyTuple_Type, &fields, &PyTuple_Type, &items))
        return NULL;
    DpFilmOptions options = options_of(self, NULL, (int)PyTuple_Size(items));
    if (read_fields(self, fields, &options) < 0) return NULL;
    DpNote* notes = dp_py_notes(items);
    if (!notes || !dp_py_enter(self->simulation)) {
        dp_free(notes);
        return NULL;
    }
    options.notes = notes;
    DpFilm*  before = self->film[MAPS];
    DpFilm*  fresh = NULL;
    DpStatus status;
    Py_BEGIN_ALLOW_THREADS
    status = dp_film_open(self->simulation->reel, &options, &fresh);
    if (status == DP_OK) dp_film_close(before);
    Py_END_ALLOW_THREADS
    if (status == DP_OK) self->film[MAPS] = fresh;
    self->simulation->busy = false;
    dp_free(notes);
    return dp_door_result(status, "opening the maps");
}

static PyMethodDef methods[] = {
    {"open_maps", film_open_maps, METH_VARARGS,
     "open_maps(((name, field), ..), ((name, str or float), ..)): channels and notes of the maps."},
    {"list_files", film_list_files, METH_VARARGS,
     "list_files(path): add each frame's file from now on to this list: name, size, digest."},
    {"write_frame", film_write_frame, METH_VARARGS,
     "write_frame(path or None, time, lean=False): take in the tiles that changed and write the "
     "frame, in the background; tells how those before went."},
    {"write_maps", film_write_maps, METH_VARARGS,
     "write_maps(path, time): write the maps as they are now, in the background, as write_frame."},
    {NULL, NULL, 0, NULL}};

static PyType_Slot type_slots[] = {
    {Py_tp_dealloc, (void*)film_dealloc},
    {Py_tp_methods, methods},
    {Py_tp_doc, "What is filmed of a Simulation: see desire_path.sim.Film."},
    {0, NULL}};

static PyType_Spec type_spec = {.name = "desire_path._native.Film",
                                .basicsize = sizeof(Film),
                                .flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION,
                                .slots = type_slots};

int dp_py_film_type(PyObject* module)
{
    PyObject* type = PyType_FromModuleAndSpec(module, &type_spec, NULL);
    if (!type) return -1;
    const int added = PyModule_AddObjectRef(module, "Film", type);
    Py_DECREF(type);
    return added;
}

// python/py_frames.c - desire_path._native.Film: frames for playback and maps of a rectangle of tiles
// of a simulation, written in the background while the ground goes on.
#include "base/alloc.h"
#include "python/py_inside.h"

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

static PyObject* outcome(DpStatus status, const char* path)
{
    return dp_py_result(status, *path ? path : "encoding a frame");
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
    return outcome(status, failed);
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
    for (int which = TRAIL; which < FILMS && status == DP_OK; ++which)
        if (self->film[which]) status = dp_film_list(self->film[which], path);
    Py_END_ALLOW_THREADS
    self->simulation->busy = false;
    return outcome(status, path);
}

PyObject* dp_py_flush(PyObject* object, PyObject* unused)
{
    Simulation* self = (Simulation*)object;
    const char* failed = "";
    DpStatus    status = DP_OK;
    (void)unused;
    if (!dp_py_enter(self)) return NULL;
    Py_BEGIN_ALLOW_THREADS
    if (self->reel) status = dp_reel_outcome(self->reel, true, &failed);
    Py_END_ALLOW_THREADS
    self->busy = false;
    return outcome(status, failed);
}

// ---- opening -----------------------------------------------------------------------------------

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
    DpAtlas     atlas = {0};
    PyObject*   o_pages = Py_None;
    if (!PyArg_ParseTuple(args, "lliis|iiO:open_frames", &tx, &ty, &nx, &ny, &software,
                          &atlas.columns, &atlas.rows, &o_pages))
        return NULL;
    DpBuffers buffers = {.count = 0};
    DpShape   shape = {2, {-1, 2}};
    if (o_pages != Py_None) {
        atlas.page = dp_buffers_open(&buffers, o_pages, "pages", 'i', &shape, false);
        if (!atlas.page) return NULL;
        atlas.pages = shape.n[0] < INT32_MAX ? (int)shape.n[0] : -1;
    }
    Film* self = make_film(simulation);
    if (!self || !dp_py_enter(simulation)) {
        Py_XDECREF((PyObject*)self);
        dp_buffers_close(&buffers);
        return NULL;
    }
    self->tile_x = tx, self->tile_y = ty;
    self->tiles_x = nx, self->tiles_y = ny;
    DpStatus status = DP_OK;
    Py_BEGIN_ALLOW_THREADS
    if (!simulation->reel)
        status = dp_reel_create(&simulation->reel, simulation->sim, simulation->workers);
    DpFilmOptions options = options_of(self, NULL, 0);
    if (atlas.page) options.atlas = &atlas;
    if (status == DP_OK)
        status = dp_film_open_playback(simulation->reel, &options, DP_PLAY_TRAIL, software,
                                       &self->film[TRAIL]);
    if (status == DP_OK && simulation->plants)
        status = dp_film_open_playback(simulation->reel, &options, DP_PLAY_LEAN, software,
                                       &self->film[LEAN]);
    Py_END_ALLOW_THREADS
    simulation->busy = false;
    dp_buffers_close(&buffers);
    if (status == DP_OK) return (PyObject*)self;
    Py_DECREF((PyObject*)self);
    return dp_py_because(status, "opening the frames",
                         "tiles_x and tiles_y must be 1 or more, and the tiles not too many, nor "
                         "too far out for exact places; pages must lie on them, and none twice");
}

// Channel names and fields from a tuple of (name, number of the field); 0, or -1 with an exception.
static int read_fields(const Film* self, PyObject* items, DpFilmOptions* options)
{
    const Py_ssize_t count = PyTuple_Size(items);
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
        if (!dp_film_shows(self->simulation->sim, *field)) {
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
    return dp_py_because(status, "opening the maps",
                         "fields and notes need names of their own that OpenEXR does not use");
}

static PyMethodDef methods[] = {
    {"open_maps", film_open_maps, METH_VARARGS,
     "open_maps(((name, field), ..), ((name, str or float), ..)): channels and notes of the maps."},
    {"list_files", film_list_files, METH_VARARGS,
     "list_files(path): add each file of frames and maps from now on to this list: name, size, "
     "digest."},
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

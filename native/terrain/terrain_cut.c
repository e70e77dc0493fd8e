// The faces of a mesh that lie near a walk, as triangles of the world: a huge mesh is looked through
// once, by all workers, and only what a foot can come near goes on.
#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "terrain/terrain.h"

#define CHUNK 32768  // points or faces looked at by one worker at a time
#define FAR 1e30f    // some programs keep an infinite number as the largest they know

// what one chunk of points or of faces found
typedef struct Chunk
{
    float low[3], high[3];
    int   bad;        // first point that is not finite, -1 = none
    bool  broken;     // a face that cannot be read
    int   count;      // points or triangles that are kept
    int   kept_from;  // how many the chunks before it keep
} Chunk;

typedef struct Cutting
{
    const DpFaces* faces;
    const double*  place;
    const double*  box;
    uint8_t*       side;        // beyond which sides of the box a point lies, a bit a side
    atomic_uchar*  used;        // whether a kept face needs the point
    uint8_t*       keeps_face;  // whether a face is kept
    int32_t*       number;      // of a used point among those kept
    Chunk*         point_chunk;
    Chunk*         face_chunk;
    DpCut*         cut;
} Cutting;

static int chunks_of(int count)
{
    return (count + CHUNK - 1) / CHUNK;
}

static int end_of(int chunk, int count)
{
    return count - chunk * CHUNK < CHUNK ? count : (chunk + 1) * CHUNK;
}

// ---- points ------------------------------------------------------------------------------------

static void look_at_points(void* context, int index, int worker)
{
    const Cutting* cutting = context;
    const float*   point = cutting->faces->point;
    Chunk*         chunk = &cutting->point_chunk[index];
    float          turn[2][4], low[3], high[3];
    (void)worker;
    for (int k = 0; k < 8; ++k) turn[k / 4][k % 4] = (float)cutting->place[k];
    for (int k = 0; k < 3; ++k) low[k] = INFINITY, high[k] = -INFINITY;
    chunk->bad = -1;
    const int end = end_of(index, cutting->faces->point_count);
    for (int n = index * CHUNK; n < end; ++n) {
        const float *p = point + 3 * (size_t)n, x = p[0], y = p[1], z = p[2];
        if (!(fabsf(x) < FAR && fabsf(y) < FAR && fabsf(z) < FAR)) {
            if (chunk->bad < 0) chunk->bad = n;
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            low[k] = p[k] < low[k] ? p[k] : low[k];
            high[k] = p[k] > high[k] ? p[k] : high[k];
        }
        if (!cutting->box) continue;
        const double u = (double)(x * turn[0][0] + y * turn[0][1] + z * turn[0][2] + turn[0][3]);
        const double v = (double)(x * turn[1][0] + y * turn[1][1] + z * turn[1][2] + turn[1][3]);
        cutting->side[n] = (uint8_t)((u < cutting->box[0]) | (v < cutting->box[1]) << 1 |
                                     (u > cutting->box[2]) << 2 | (v > cutting->box[3]) << 3);
    }
    memcpy(chunk->low, low, sizeof low);
    memcpy(chunk->high, high, sizeof high);
}

static void count_points(void* context, int index, int worker)
{
    const Cutting* cutting = context;
    const int      end = end_of(index, cutting->faces->point_count);
    int            count = 0;
    (void)worker;
    for (int n = index * CHUNK; n < end; ++n)
        count += atomic_load_explicit(&cutting->used[n], memory_order_relaxed);
    cutting->point_chunk[index].count = count;
}

// number what is used, and place it in the world
static void take_points(void* context, int index, int worker)
{
    const Cutting* cutting = context;
    const float*   point = cutting->faces->point;
    const int      end = end_of(index, cutting->faces->point_count);
    int            number = cutting->point_chunk[index].kept_from;
    (void)worker;
    for (int n = index * CHUNK; n < end; ++n) {
        if (!atomic_load_explicit(&cutting->used[n], memory_order_relaxed)) continue;
        const float* p = point + 3 * (size_t)n;
        double*      out = cutting->cut->vertex + 3 * (size_t)number;
        for (int k = 0; k < 3; ++k) {
            const double* row = cutting->place + 4 * k;
            out[k] = (double)p[0] * row[0] + (double)p[1] * row[1] + (double)p[2] * row[2] + row[3];
        }
        cutting->cut->of[number] = n;
        cutting->number[n] = number++;
    }
}

// ---- faces -------------------------------------------------------------------------------------

// corners of a face; how many, 0 = none that can be read
static inline int face_of(const DpFaces* faces, int face, const int32_t** corner)
{
    const int from = faces->start ? faces->start[face] : face * faces->sides;
    const int sides = faces->start ? faces->start[face + 1] - from : faces->sides;
    if (from < 0 || (sides != 3 && sides != 4) || from > faces->corner_count - sides) return 0;
    *corner = faces->corner + from;
    return sides;
}

static void look_at_faces(void* context, int index, int worker)
{
    const Cutting* cutting = context;
    const DpFaces* faces = cutting->faces;
    Chunk*         chunk = &cutting->face_chunk[index];
    const int      end = end_of(index, faces->face_count);
    const uint32_t points = (uint32_t)faces->point_count;
    int            count = 0;
    (void)worker;
    for (int f = index * CHUNK; f < end; ++f) {
        const int32_t* corner;
        const int      sides = face_of(faces, f, &corner);
        unsigned       beyond = 0xff;
        bool           broken = sides == 0;
        for (int k = 0; k < sides; ++k) broken |= (uint32_t)corner[k] >= points;
        if (broken) {
            chunk->broken = true;
            return;
        }
        for (int k = 0; k < sides; ++k) beyond &= cutting->side[corner[k]];
        if (beyond) continue;
        cutting->keeps_face[f] = 1;
        count += sides - 2;
        for (int k = 0; k < sides; ++k)
            atomic_store_explicit(&cutting->used[corner[k]], 1, memory_order_relaxed);
    }
    chunk->count = count;
}

// whether a quad's diagonal from its first corner lies outside
static bool is_dented(const float* point, const int32_t corner[4])
{
    const float* from = point + 3 * (size_t)corner[0];
    float        to[3][3], left[3], right[3];
    for (int c = 0; c < 3; ++c) {
        const float* at = point + 3 * (size_t)corner[c + 1];
        for (int k = 0; k < 3; ++k) to[c][k] = at[k] - from[k];
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        left[k] = to[0][i] * to[1][j] - to[0][j] * to[1][i];
        right[k] = to[1][i] * to[2][j] - to[1][j] * to[2][i];
    }
    return left[0] * right[0] + left[1] * right[1] + left[2] * right[2] < 0.0f;
}

static void take_faces(void* context, int index, int worker)
{
    const Cutting* cutting = context;
    const DpFaces* faces = cutting->faces;
    const int      end = end_of(index, faces->face_count);
    int32_t*       out = cutting->cut->triangle + 3 * (size_t)cutting->face_chunk[index].kept_from;
    (void)worker;
    for (int f = index * CHUNK; f < end; ++f) {
        if (!cutting->keeps_face[f]) continue;
        const int32_t* corner;
        const int      sides = face_of(faces, f, &corner);
        const int      turn = sides == 4 && is_dented(faces->point, corner) ? 3 : 0;
        int32_t        at[4];
        for (int k = 0; k < sides; ++k) at[k] = cutting->number[corner[(k + turn) % sides]];
        for (int t = 2; t < sides; ++t, out += 3)
            out[0] = at[0], out[1] = at[t - 1], out[2] = at[t];
    }
}

// ---- the door ----------------------------------------------------------------------------------

// how many all keep, each chunk knowing how many come before
static int sum_up(Chunk* chunk, int chunks)
{
    int sum = 0;
    for (int c = 0; c < chunks; ++c) {
        chunk[c].kept_from = sum;
        sum += chunk[c].count;
    }
    return sum;
}

static DpStatus look(const Cutting* cutting, int workers)
{
    DpCut*    cut = cutting->cut;
    const int chunks = chunks_of(cutting->faces->point_count);
    cut->bad = -1;
    for (int k = 0; k < 3; ++k) cut->low[k] = INFINITY, cut->high[k] = -INFINITY;
    dp_parallel_for(chunks, workers, look_at_points, (void*)cutting);
    for (int c = 0; c < chunks; ++c) {
        const Chunk* chunk = &cutting->point_chunk[c];
        if (cut->bad < 0) cut->bad = chunk->bad;
        for (int k = 0; k < 3; ++k) {
            cut->low[k] = fminf(cut->low[k], chunk->low[k]);
            cut->high[k] = fmaxf(cut->high[k], chunk->high[k]);
        }
    }
    if (cut->bad >= 0) return DP_OK;
    dp_parallel_for(chunks_of(cutting->faces->face_count), workers, look_at_faces, (void*)cutting);
    for (int c = 0; c < chunks_of(cutting->faces->face_count); ++c)
        if (cutting->face_chunk[c].broken) return DP_BAD_ARGUMENT;
    return DP_OK;
}

static DpStatus take(const Cutting* cutting, int workers)
{
    DpCut*    cut = cutting->cut;
    const int chunks = chunks_of(cutting->faces->point_count);
    const int face_chunks = chunks_of(cutting->faces->face_count);
    dp_parallel_for(chunks, workers, count_points, (void*)cutting);
    cut->point_count = sum_up(cutting->point_chunk, chunks);
    cut->triangle_count = sum_up(cutting->face_chunk, face_chunks);
    cut->of = dp_alloc((size_t)cut->point_count + 1, sizeof *cut->of);
    cut->vertex = dp_alloc((size_t)cut->point_count + 1, 3 * sizeof *cut->vertex);
    cut->triangle = dp_alloc((size_t)cut->triangle_count + 1, 3 * sizeof *cut->triangle);
    if (!cut->of || !cut->vertex || !cut->triangle) return DP_NO_MEMORY;
    dp_parallel_for(chunks, workers, take_points, (void*)cutting);
    dp_parallel_for(face_chunks, workers, take_faces, (void*)cutting);
    return DP_OK;
}

DpStatus dp_mesh_cut(const DpFaces* faces, const double place[12], const double* box, int workers,
                     DpCut* cut)
{
    memset(cut, 0, sizeof *cut);
    if (faces->point_count < 0 || faces->face_count < 0 || faces->face_count > INT32_MAX / 6 ||
        faces->point_count > INT32_MAX - CHUNK)
        return DP_BAD_ARGUMENT;
    const size_t  points = (size_t)faces->point_count, count = (size_t)faces->face_count;
    const Cutting cutting = {faces,
                             place,
                             box,
                             dp_alloc(points + 1, 1),
                             dp_alloc(points + 1, 1),
                             dp_alloc(count + 1, 1),
                             dp_alloc(points + 1, sizeof(int32_t)),
                             dp_alloc((size_t)chunks_of(faces->point_count) + 1, sizeof(Chunk)),
                             dp_alloc((size_t)chunks_of(faces->face_count) + 1, sizeof(Chunk)),
                             cut};
    DpStatus      status = DP_NO_MEMORY;
    if (cutting.side && cutting.used && cutting.keeps_face && cutting.number &&
        cutting.point_chunk && cutting.face_chunk)
        status = look(&cutting, workers);
    if (status == DP_OK && cut->bad < 0) status = take(&cutting, workers);
    if (status != DP_OK) dp_cut_free(cut);
    dp_free(cutting.side);
    dp_free(cutting.used);
    dp_free(cutting.keeps_face);
    dp_free(cutting.number);
    dp_free(cutting.point_chunk);
    dp_free(cutting.face_chunk);
    return status;
}

void dp_cut_free(DpCut* cut)
{
    dp_free(cut->of);
    dp_free(cut->vertex);
    dp_free(cut->triangle);
    memset(cut, 0, sizeof *cut);
}

// ---- faces by their edges ----------------------------------------------------------------------

typedef struct Edges
{
    const int32_t* corner;       // (corners)
    const int32_t* corner_edge;  // (corners)
    const int32_t* edge;         // (edges, 2)
    int            corners, edges;
    atomic_bool    other;
} Edges;

static bool joins(const Edges* edges, int corner, int next)
{
    const int32_t e = edges->corner_edge[corner];
    if (e < 0 || e >= edges->edges) return false;
    const int32_t *two = edges->edge + 2 * (size_t)e, a = edges->corner[corner],
                  b = edges->corner[next];
    return (two[0] == a && two[1] == b) || (two[0] == b && two[1] == a);
}

static void look_at_edges(void* context, int index, int worker)
{
    Edges*    edges = context;
    const int end = end_of(index, edges->corners / 4);
    (void)worker;
    for (int q = index * CHUNK; q < end; ++q)
        if (!joins(edges, 4 * q + 2, 4 * q + 3) || !joins(edges, 4 * q + 3, 4 * q)) {
            atomic_store(&edges->other, true);
            return;
        }
}

// A corner's edge leads to the next corner of its face, from the last to the first. Let all faces
// before corner c be quads. Were the next one a triangle, the edge of c + 2 would lead to c: it leads
// to c + 3, so that c + 3 lies on c's point and its edge, leading to c, has no length. Had it more
// than four corners, c + 4 would lie on c's point: no face meets a point twice.
bool dp_are_quads(int corners, const int32_t* corner, const int32_t* corner_edge, int edges,
                  const int32_t* edge, int workers)
{
    Edges all = {corner, corner_edge, edge, corners, edges, false};
    if (corners % 4) return false;
    dp_parallel_for(chunks_of(corners / 4), workers, look_at_edges, &all);
    return !atomic_load(&all.other);
}

// ---- points and cells --------------------------------------------------------------------------

typedef struct Offsets
{
    const double* vertex;
    const double* origin;
    double        cell, max_offset;
    int           count;
    atomic_bool   off;
} Offsets;

static void look_for_centres(void* context, int index, int worker)
{
    Offsets*  offsets = context;
    const int end = end_of(index, offsets->count);
    (void)worker;
    if (atomic_load(&offsets->off)) return;
    for (int n = index * CHUNK; n < end; ++n)
        for (int k = 0; k < 2; ++k) {
            const double at =
                (offsets->vertex[3 * (size_t)n + (size_t)k] - offsets->origin[k]) / offsets->cell;
            const bool   near = fabs(at) < 1e15;  // farther out a cell has no middle any more
            const double into = near ? at - (double)(int64_t)at : 0.0;  // of its cell, -1..1
            if (!near || !(fabs(fabs(into) - 0.5) < offsets->max_offset)) {
                atomic_store(&offsets->off, true);
                return;
            }
        }
}

bool dp_are_centres(int count, const double* vertex, double cell, const double origin[2],
                    double max_offset, int workers)
{
    Offsets offsets = {vertex, origin, cell, max_offset, count, false};
    dp_parallel_for(chunks_of(count), workers, look_for_centres, &offsets);
    return !atomic_load(&offsets.off);
}

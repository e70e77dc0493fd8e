// Triangles are put into grids of bins, each grid twice as coarse as the one before.
//
// A triangle stands once: in the bin of its lower left corner, in the finest grid where it ends in that
// bin or in the next one.
#include "terrain/terrain_bins.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "terrain/terrain_facet.h"

#define MAX_BINS 30000      // along one side
#define FINEST 1e-100       // of the ground's box [m]: thinner is none
#define CHUNK 32768         // triangles or points looked at by one worker at a time
#define NOWHERE UINT32_MAX  // the bin of a triangle that is not ground

// the finest grid a triangle fits, and its bin there
static uint32_t place_of(const MeshGround* mesh, const Facet* facet)
{
    const Bins at = bins_of(mesh, facet->x_min, facet->x_max, facet->y_min, facet->y_max);
    int        l = 0;
    while ((at.x1 >> l) - (at.x0 >> l) > 1 || (at.y1 >> l) - (at.y0 >> l) > 1) ++l;
    const BinGrid* grid = &mesh->grid[l];
    return (uint32_t)(grid->first + (at.y0 >> l) * grid->nx + (at.x0 >> l));
}

// a few triangles a bin
static void choose_bins(MeshGround* mesh, const double bounds[4], size_t triangles)
{
    const double wide = bounds[2] - bounds[0], high = bounds[3] - bounds[1];
    const double longer = fmax(wide, high);
    const double bin = fmax(2.0 * sqrt(wide * high / (double)triangles),
                            longer / fmin((double)triangles, (double)MAX_BINS));
    mesh->x0 = bounds[0], mesh->y0 = bounds[1];
    mesh->per_bin = 1.0 / bin;
    mesh->nx = (int)(wide / bin) + 1;
    mesh->ny = (int)(high / bin) + 1;
    int first = 0;
    for (int l = 0;; ++l) {
        const int nx = ((mesh->nx - 1) >> l) + 1, ny = ((mesh->ny - 1) >> l) + 1;
        mesh->grid[l] = (BinGrid){nx, ny, first, false};
        first += nx * ny;
        mesh->grids = l + 1;
        if (nx == 1 && ny == 1) break;
    }
    mesh->bins = first;
}

typedef struct Binning
{
    const DpGround* ground;
    MeshGround*     mesh;
    uint32_t*       place;  // bin of every triangle
    struct Share
    {
        double bounds[4];
        size_t facing;
        bool   bad;
    } * share;  // what every chunk found
} Binning;

static int chunks_of(size_t count)
{
    return (int)((count + CHUNK - 1) / CHUNK);
}

static int end_of(int chunk, int count)
{
    return count - chunk * CHUNK < CHUNK ? count : (chunk + 1) * CHUNK;
}

static void take_points(void* context, int chunk, int worker)
{
    Binning*      binning = context;
    struct Share* share = &binning->share[chunk];
    const double* vertex = binning->ground->vertex;
    const size_t  first = 3 * (size_t)chunk * CHUNK;
    const size_t  end = 3 * (size_t)end_of(chunk, binning->ground->vertex_count);
    double        x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    bool          bad = false;
    (void)worker;
    for (size_t n = first; n < end; n += 3) {
        const double x = vertex[n], y = vertex[n + 1], z = vertex[n + 2];
        bad |= !(fabs(x) < 1e100 && fabs(y) < 1e100 && fabs(z) < 1e100);  // squares are finite
        x0 = x < x0 ? x : x0, x1 = x > x1 ? x : x1;
        y0 = y < y0 ? y : y0, y1 = y > y1 ? y : y1;
    }
    *share = (struct Share){{x0, y0, x1, y1}, 0, bad};
    memcpy(binning->mesh->vertex + first, vertex + first, (end - first) * sizeof *vertex);
}

static void take_triangles(void* context, int chunk, int worker)
{
    Binning*       binning = context;
    MeshGround*    mesh = binning->mesh;
    struct Share*  share = &binning->share[chunk];
    const int32_t* corner = binning->ground->triangle;
    const int      end = end_of(chunk, mesh->triangle_count);
    double         x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    (void)worker;
    *share = (struct Share){{0.0}, 0, false};
    for (int t = chunk * CHUNK; t < end; ++t) {
        for (size_t n = 3 * (size_t)t; n < 3 * (size_t)t + 3; ++n) {
            share->bad |= corner[n] < 0 || corner[n] >= mesh->vertex_count;
            mesh->triangle[n] = corner[n];
        }
        if (share->bad) return;
        const Facet facet = facet_of(mesh, t);
        binning->place[t] = facet.sign == 0.0 ? NOWHERE : place_of(mesh, &facet);
        if (facet.sign == 0.0) continue;
        ++share->facing;
        const double left = min3(facet.x), right = max3(facet.x);
        const double near = min3(facet.y), far = max3(facet.y);
        x0 = left < x0 ? left : x0, x1 = right > x1 ? right : x1;
        y0 = near < y0 ? near : y0, y1 = far > y1 ? far : y1;
    }
    share->bounds[0] = x0, share->bounds[1] = y0, share->bounds[2] = x1, share->bounds[3] = y1;
}

// the box of all chunks; false when one is bad
static bool sum_up(const struct Share* share, int chunks, double bounds[4], size_t* facing)
{
    bounds[0] = bounds[1] = INFINITY, bounds[2] = bounds[3] = -INFINITY;
    *facing = 0;
    for (int c = 0; c < chunks; ++c, ++share) {
        if (share->bad) return false;
        *facing += share->facing;
        for (int k = 0; k < 2; ++k) {
            bounds[k] = fmin(bounds[k], share->bounds[k]);
            bounds[k + 2] = fmax(bounds[k + 2], share->bounds[k + 2]);
        }
    }
    return true;
}

// points, then triangles, copied, looked through and given their places; how many of them face up
// or down, and where these lie
static DpStatus take_mesh(Binning* binning, int workers, double bounds[4], size_t* facing)
{
    const DpGround* ground = binning->ground;
    const int       point_chunks = chunks_of((size_t)ground->vertex_count);
    const int       chunks = chunks_of((size_t)ground->triangle_count);
    dp_parallel_for(point_chunks, workers, take_points, binning);
    if (!sum_up(binning->share, point_chunks, bounds, facing)) return DP_BAD_ARGUMENT;
    for (bool again = false;; again = true) {
        double box[4];
        memcpy(box, bounds, sizeof box);
        for (int k = 0; k < 2; ++k)  // wide enough to be cut into bins, however far off it lies
            if (!(box[k + 2] - box[k] > FINEST)) box[k + 2] += 1.0 + 1e-9 * fabs(box[k]);
        choose_bins(binning->mesh, box, (size_t)ground->triangle_count);
        dp_parallel_for(chunks, workers, take_triangles, binning);
        if (!sum_up(binning->share, chunks, bounds, facing)) return DP_BAD_ARGUMENT;
        if (*facing == 0) return DP_NO_GROUND;
        // points of no triangle may lie far off: then once more, with bins where the ground is
        const double wide = bounds[2] - bounds[0], high = bounds[3] - bounds[1];
        if (again || 4.0 * wide * high >= (box[2] - box[0]) * (box[3] - box[1])) return DP_OK;
    }
}

// counted, summed up, filled from the back: ascending within a bin
static bool fill_bins(MeshGround* mesh, const uint32_t* place, size_t facing)
{
    mesh->start = dp_alloc((size_t)mesh->bins + 1, sizeof *mesh->start);
    mesh->item = dp_alloc(facing, sizeof *mesh->item);
    if (!mesh->start || !mesh->item) return false;
    for (int32_t t = 0; t < mesh->triangle_count; ++t)
        if (place[t] != NOWHERE) ++mesh->start[place[t]];
    int32_t sum = 0;
    for (int b = 0; b <= mesh->bins; ++b) {
        sum += mesh->start[b];
        mesh->start[b] = sum;  // where the bin ends; placing moves it back to where it begins
    }
    for (int32_t t = mesh->triangle_count; t-- > 0;)
        if (place[t] != NOWHERE) mesh->item[--mesh->start[place[t]]] = t;
    for (int l = 0; l < mesh->grids; ++l) {
        BinGrid* grid = &mesh->grid[l];
        grid->used = mesh->start[grid->first] < mesh->start[grid->first + grid->nx * grid->ny];
    }
    return true;
}

DpStatus dp_mesh_create(MeshGround* mesh, const DpGround* ground, int workers, double bounds[4])
{
    if (ground->vertex_count < 3 || ground->triangle_count < 1 || !ground->vertex ||
        !ground->triangle)
        return DP_BAD_ARGUMENT;
    const size_t points = (size_t)ground->vertex_count, triangles = (size_t)ground->triangle_count;
    const int    chunks = chunks_of(points > triangles ? points : triangles);
    mesh->vertex_count = ground->vertex_count;
    mesh->triangle_count = ground->triangle_count;
    mesh->vertex = dp_alloc(points, 3 * sizeof(double));
    mesh->triangle = dp_alloc(triangles, 3 * sizeof(int32_t));
    Binning  binning = {ground, mesh, dp_alloc(triangles, sizeof(uint32_t)),
                        dp_alloc((size_t)chunks, sizeof(struct Share))};
    size_t   facing = 0;
    DpStatus status = DP_NO_MEMORY;
    if (mesh->vertex && mesh->triangle && binning.place && binning.share)
        status = take_mesh(&binning, workers, bounds, &facing);
    if (status == DP_OK) {
        int32_t t = 0;
        while (binning.place[t] == NOWHERE) ++t;
        mesh->somewhere = mesh->vertex[3 * (size_t)mesh->triangle[3 * (size_t)t] + 2];
    }
    if (status == DP_OK && !fill_bins(mesh, binning.place, facing)) status = DP_NO_MEMORY;
    dp_free(binning.place);
    dp_free(binning.share);
    return status;
}

void dp_mesh_destroy(MeshGround* mesh)
{
    dp_free(mesh->vertex);
    dp_free(mesh->triangle);
    dp_free(mesh->start);
    dp_free(mesh->item);
}

// The underside of a posed limb, one column per cell. TRAIL 4.2.1, MODEL 5.1
//
//   pose every corner -> find the samples it can cover -> lower them -> one mean a cell
//
// On a patch that is its own mirror image a mirrored sole gives a mirrored imprint, to the bit:
// positions are measured from the patch's middle and sums are taken in pairs from both ends.
#include <math.h>

#include "base/alloc.h"
#include "base/vec.h"
#include "base/wide.h"
#include "imprint/imprint.h"
#include "imprint/imprint_raster.h"

#define MAX_SAMPLES 4
#define MAX_CELLS (1 << 24)  // along one side of a patch: 64-bit sizes and exact floats below it

struct DpImprintScratch
{
    double*       corner;   // posed corners (u, v, z)
    float*        low;      // samples
    float*        sum;      // one row of cells: heights summed down each column of samples
    float*        covered;  // and how many there were
    DpSampleRect* due;      // triangles of one sole
};

DpImprintScratch* dp_imprint_scratch_create(void)
{
    return dp_alloc(1, sizeof(DpImprintScratch));
}

void dp_imprint_scratch_destroy(DpImprintScratch* scratch)
{
    if (!scratch) return;
    dp_free(scratch->corner);
    dp_free(scratch->low);
    dp_free(scratch->sum);
    dp_free(scratch->covered);
    dp_free(scratch->due);
    dp_free(scratch);
}

DpBox dp_imprint_box(const DpMesh* sole, DpPose pose)
{
    DpBox box = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (int n = 0; n < sole->vertex_count; ++n) {
        const float* at = sole->vertex + 3 * (size_t)n;
        const DpVec3 p = dp_place(pose, dp_vec3((double)at[0], (double)at[1], (double)at[2]));
        box.x0 = p.x < box.x0 ? p.x : box.x0, box.x1 = p.x > box.x1 ? p.x : box.x1;
        box.y0 = p.y < box.y0 ? p.y : box.y0, box.y1 = p.y > box.y1 ? p.y : box.y1;
        box.z0 = p.z < box.z0 ? p.z : box.z0, box.z1 = p.z > box.z1 ? p.z : box.z1;
    }
    return box;
}

int dp_imprint_samples(double cell, double length)
{
    const double apart = length < 0.25 ? 0.01 * length : 0.0025;
    const double wanted = cell / apart;
    return wanted >= MAX_SAMPLES - 0.5 ? MAX_SAMPLES : wanted < 1.5 ? 1 : (int)(wanted + 0.5);
}

static bool is_patch(const DpSoilPatch* patch)
{
    return patch->nx > 0 && patch->ny > 0 && patch->row >= patch->nx && patch->nx < MAX_CELLS &&
           patch->ny < MAX_CELLS && patch->cell > 0.0 && isfinite(patch->cell) &&
           isfinite(patch->x0) && isfinite(patch->y0);
}

static bool is_mesh(const DpMesh* mesh)
{
    if (mesh->vertex_count < 0 || mesh->triangle_count < 0) return false;
    uint32_t     largest = 0;  // a negative index is a huge one
    const size_t count = 3 * (size_t)mesh->triangle_count;
    for (size_t n = 0; n < count; ++n) {
        const uint32_t index = (uint32_t)mesh->triangle[n];
        largest = index > largest ? index : largest;
    }
    return count == 0 || largest < (uint32_t)mesh->vertex_count;
}

// a patch's middle and the length of half a sample step
typedef struct Frame
{
    double x, y, per_metre;
} Frame;

// a turn as rows of a matrix
typedef struct Turn
{
    DpVec3 x, y, z;
} Turn;

static Turn turn_of(DpQuat q)
{
    const Turn turn = {{1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y - q.w * q.z),
                        2.0 * (q.x * q.z + q.w * q.y)},
                       {2.0 * (q.x * q.y + q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
                        2.0 * (q.y * q.z - q.w * q.x)},
                       {2.0 * (q.x * q.z - q.w * q.y), 2.0 * (q.y * q.z + q.w * q.x),
                        1.0 - 2.0 * (q.x * q.x + q.y * q.y)}};
    return turn;
}

// corners of one posed sole in sample steps; box grows around them. False: one is not a number.
static bool pose_corners(const DpMesh* sole, DpPose pose, const Frame* frame, double* corner,
                         DpBox* box)
{
    const Turn turn = turn_of(pose.turn);
    DpBox      b = *box;
    double     zero = 0.0;
    for (int n = 0; n < sole->vertex_count; ++n, corner += 3) {
        const float* at = sole->vertex + 3 * (size_t)n;
        const double x = (double)at[0], y = (double)at[1], z = (double)at[2];
        const double px = pose.at.x + (turn.x.x * x + turn.x.y * y + turn.x.z * z);
        const double py = pose.at.y + (turn.y.x * x + turn.y.y * y + turn.y.z * z);
        const double w = pose.at.z + (turn.z.x * x + turn.z.y * y + turn.z.z * z);
        const double u = (px - frame->x) * frame->per_metre;
        const double v = (py - frame->y) * frame->per_metre;
        corner[0] = u, corner[1] = v, corner[2] = w;
        b.x0 = u < b.x0 ? u : b.x0, b.x1 = u > b.x1 ? u : b.x1;
        b.y0 = v < b.y0 ? v : b.y0, b.y1 = v > b.y1 ? v : b.y1;
        b.z0 = w < b.z0 ? w : b.z0, b.z1 = w > b.z1 ? w : b.z1;
        zero += ((u - u) + (v - v)) + (w - w);  // NaN and infinity do not go away
    }
    *box = b;
    return zero == 0.0;
}

// down the columns of one row of cells, rows in pairs from both ends
DP_INLINE void sum_columns(const float* low, int row, int width, int samples, float* sum,
                           float* covered)
{
    for (int p = 0; p < width; ++p) sum[p] = covered[p] = 0.0f;
    for (int q = 0; 2 * q < samples; ++q) {
        const float* one = low + (size_t)q * (size_t)row;
        const float* two = low + (size_t)(samples - 1 - q) * (size_t)row;
        const float  twice = one == two ? 0.0f : 1.0f;  // the middle row counts once
        for (int p = 0; p < width; ++p) {
            const float in_one = one[p] < INFINITY ? 1.0f : 0.0f;
            const float in_two = two[p] < INFINITY ? twice : 0.0f;
            const float z_one = one[p] < INFINITY ? one[p] : 0.0f;
            const float z_two = two[p] < INFINITY ? two[p] : 0.0f;
            sum[p] += z_one + z_two * twice;
            covered[p] += in_one + in_two;
        }
    }
}

// one row of cells: mean over the covered samples, columns in pairs from both ends. At most 16
// heights above the lowest point: float sums are good to a millionth of the sole's height.
DP_INLINE void mean_cells(const float* sum, const float* covered, int cells, int samples,
                          double lowest, float* bottom, float* cover)
{
    const float share = 1.0f / (float)(samples * samples);
    for (int i = 0; i < cells; ++i, sum += samples, covered += samples) {
        float z = 0.0f, count = 0.0f;
        for (int p = 0; p < samples / 2; ++p) {
            z += sum[p] + sum[samples - 1 - p];
            count += covered[p] + covered[samples - 1 - p];
        }
        if (samples & 1) {
            z += sum[samples / 2];
            count += covered[samples / 2];
        }
        const float counted = count > 0.0f ? count : 1.0f;
        bottom[i] = count > 0.0f ? (float)(lowest + (double)z / (double)counted) : INFINITY;
        cover[i] = count * share;
    }
}

DP_CLONES static void mean_row(const DpSamples* window, const float* low, int cells, int samples,
                               double lowest, DpImprintScratch* scratch, float* bottom,
                               float* cover)
{
    const int width = cells * samples;
    sum_columns(low, window->row, width, samples, scratch->sum, scratch->covered);
    const float* sum = scratch->sum;
    const float* covered = scratch->covered;
    switch (samples) {  // said four times, so that each is built with its number known
        case 1:
            mean_cells(sum, covered, cells, 1, lowest, bottom, cover);
            break;
        case 2:
            mean_cells(sum, covered, cells, 2, lowest, bottom, cover);
            break;
        case 3:
            mean_cells(sum, covered, cells, 3, lowest, bottom, cover);
            break;
        default:
            mean_cells(sum, covered, cells, MAX_SAMPLES, lowest, bottom, cover);
            break;
    }
}

DP_CLONES static void no_sole_in_row(float* restrict bottom, float* restrict cover, int width)
{
    for (int i = 0; i < width; ++i) bottom[i] = INFINITY;
    for (int i = 0; i < width; ++i) cover[i] = 0.0f;
}

static void no_sole(DpImprint* imprint, const DpSoilPatch* patch)
{
    for (int j = 0; j < patch->ny; ++j) {
        const size_t at = (size_t)j * (size_t)patch->row;
        no_sole_in_row(imprint->bottom + at, imprint->cover + at, patch->nx);
    }
    imprint->i0 = imprint->i1 = imprint->j0 = imprint->j1 = 0;
}

// the tightest rectangle about columns with cover > 0, within i0..i1, j0..j1
static void find_box(DpImprint* imprint, int row, int i0, int i1, int j0, int j1)
{
    int left = i1, right = i0, top = j1, bottom = j0;
    for (int j = j0; j < j1; ++j) {
        const float* cover = imprint->cover + (size_t)j * (size_t)row;
        int          first = i0, last = i1;
        while (first < i1 && !(cover[first] > 0.0f)) ++first;
        if (first == i1) continue;
        while (!(cover[last - 1] > 0.0f)) --last;
        left = first < left ? first : left;
        right = last > right ? last : right;
        top = j < top ? j : top;
        bottom = j + 1;
    }
    if (left >= right) left = right = top = bottom = 0;
    imprint->i0 = left, imprint->i1 = right, imprint->j0 = top, imprint->j1 = bottom;
}

DpStatus dp_imprint_foot(DpImprint* imprint, const DpSoilPatch* patch, const DpMesh* soles,
                         const DpPose* poses, int count, int samples, DpImprintScratch* scratch)
{
    if (!is_patch(patch) || count < 0 || samples < 1 || samples > MAX_SAMPLES)
        return DP_BAD_ARGUMENT;
    size_t corners = 0, max_triangles = 0;
    for (int s = 0; s < count; ++s) {
        if (!is_mesh(&soles[s])) return DP_BAD_ARGUMENT;
        corners += (size_t)soles[s].vertex_count;
        const size_t triangles = (size_t)soles[s].triangle_count;
        max_triangles = triangles > max_triangles ? triangles : max_triangles;
    }
    if (!dp_make_room(&scratch->corner, corners, 3 * sizeof *scratch->corner)) return DP_NO_MEMORY;

    const Frame frame = {patch->x0 + 0.5 * (double)(patch->nx - 1) * patch->cell,
                         patch->y0 + 0.5 * (double)(patch->ny - 1) * patch->cell,
                         2.0 * (double)samples / patch->cell};
    DpBox       box = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
    double*     corner = scratch->corner;
    for (int s = 0; s < count; ++s) {
        if (!pose_corners(&soles[s], poses[s], &frame, corner, &box)) return DP_BAD_ARGUMENT;
        corner += 3 * (size_t)soles[s].vertex_count;
    }
    for (size_t n = 0; n < corners; ++n) scratch->corner[3 * n + 2] -= box.z0;

    // whole cells whose samples the box can hold
    DpSamples window = {0};
    window.past_u = patch->nx * samples - 1;
    window.past_v = patch->ny * samples - 1;
    int p0 = dp_samples_first(box.x0, window.past_u), p1 = dp_samples_last(box.x1, window.past_u);
    int q0 = dp_samples_first(box.y0, window.past_v), q1 = dp_samples_last(box.y1, window.past_v);
    p0 = p0 < 0 ? 0 : p0, p1 = p1 > window.past_u ? window.past_u : p1;
    q0 = q0 < 0 ? 0 : q0, q1 = q1 > window.past_v ? window.past_v : q1;
    if (corners == 0 || p0 > p1 || q0 > q1) {
        no_sole(imprint, patch);
        return DP_OK;
    }
    const int i0 = p0 / samples, i1 = p1 / samples + 1;
    const int j0 = q0 / samples, j1 = q1 / samples + 1;
    window.p0 = i0 * samples, window.p1 = i1 * samples;
    window.q0 = j0 * samples, window.q1 = j1 * samples;
    window.row = (window.p1 - window.p0 + 15) / 8 * 8;

    const size_t size = (size_t)window.row * (size_t)(window.q1 - window.q0);
    const size_t row = (size_t)window.row;
    if (!dp_make_room(&scratch->low, size, sizeof *scratch->low) ||
        !dp_make_room(&scratch->sum, row, sizeof *scratch->sum) ||
        !dp_make_room(&scratch->covered, row, sizeof *scratch->covered) ||
        !dp_make_room(&scratch->due, max_triangles, sizeof *scratch->due))
        return DP_NO_MEMORY;
    window.low = scratch->low;
    for (size_t n = 0; n < size; ++n) window.low[n] = INFINITY;

    corner = scratch->corner;
    for (int s = 0; s < count; ++s) {
        dp_samples_lower(&window, corner, soles[s].triangle, soles[s].triangle_count, scratch->due);
        corner += 3 * (size_t)soles[s].vertex_count;
    }

    no_sole(imprint, patch);
    for (int j = j0; j < j1; ++j) {
        const size_t at = (size_t)j * (size_t)patch->row + (size_t)i0;
        const float* low = window.low + (size_t)((j - j0) * samples) * (size_t)window.row;
        mean_row(&window, low, i1 - i0, samples, box.z0, scratch, imprint->bottom + at,
                 imprint->cover + at);
    }
    find_box(imprint, patch->row, i0, i1, j0, j1);
    return DP_OK;
}

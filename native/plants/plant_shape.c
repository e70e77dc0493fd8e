// plants/plant_shape.c - the shape that a plant of a kind returns to, and what holds it. TRAIL 4.1
#include "plants/plant_inside.h"

// squared frequency of a stem of n free particles, of mass and bending stiffness 1: the lowest
// eigenvalue of B^T B, B the second differences, by inverse iteration
static double lowest_mode(int n)
{
    double u[DP_PLANT_MAX_ROWS], v[DP_PLANT_MAX_ROWS], size = 1.0;
    for (int k = 0; k < n; ++k) u[k] = k + 1.0;
    for (int pass = 0; pass < 30; ++pass) {
        for (int k = n - 1; k >= 0; --k)  // B^T v = u
            v[k] = u[k] + (k + 1 < n ? 2.0 * v[k + 1] : 0.0) - (k + 2 < n ? v[k + 2] : 0.0);
        for (int k = 0; k < n; ++k)  // B u = v
            u[k] = v[k] + (k > 0 ? 2.0 * u[k - 1] : 0.0) - (k > 1 ? u[k - 2] : 0.0);
        double sum = 0.0;
        for (int k = 0; k < n; ++k) sum += u[k] * u[k];
        size = sqrt(sum);
        for (int k = 0; k < n; ++k) u[k] /= size;
    }
    return 1.0 / size;
}

// a stem rises from its foot and bends outward by curl at every particle
static void rest_shape(PlantStand* stand)
{
    const DpPlantKind* kind = &stand->kind;
    const DpPlantShape shape = stand->shape;
    const int          sheets = shape.stems / shape.stems_a_sheet, columns = shape.stems_a_sheet;
    stand->gap = kind->height / (float)(shape.rows - DP_PLANT_HELD);
    for (int s = 0; s < sheets; ++s)
        for (int c = 0; c < columns; ++c) {
            const double along = DP_PI * s / sheets, ax = cos(along), ay = sin(along);
            const double wide = (double)(s == 0 ? kind->width : kind->depth);
            const double off = columns > 1 ? wide * (c / (columns - 1.0) - 0.5) : 0.0;
            const double side = off > 1e-9 ? 1.0 : off < -1e-9 ? -1.0 : 0.0;
            const double dx = kind->form == DP_PLANT_TUFT ? side * ax : -ay;
            const double dy = kind->form == DP_PLANT_TUFT ? side * ay : ax;
            double       x = off * ax, y = off * ay, z = -(double)stand->gap;
            float*       at = stand->rest + 3 * (s * columns + c) * shape.rows;
            for (int r = 0; r < shape.rows; ++r, at += 3) {
                at[0] = (float)x, at[1] = (float)y, at[2] = (float)z;
                const double far = sqrt(x * x + y * y + z * z);
                if (far > (double)stand->extent) stand->extent = (float)far;
                stand->aside = fmaxf(stand->aside, (float)sqrt(x * x + y * y));
                const double lean = dx != 0.0 || dy != 0.0 ? (double)kind->curl * r : 0.0;
                const double angle = lean < 0.9 * DP_PI ? lean : 0.9 * DP_PI;  // no stem rolls up
                x += (double)stand->gap * sin(angle) * dx;
                y += (double)stand->gap * sin(angle) * dy;
                z += (double)stand->gap * cos(angle);
                if (r > 0 && z < 0.0) z = 0.0;
            }
        }
    // a stem as long as it is may lie down
    const float span = kind->height + 0.5f * fmaxf(kind->width, kind->depth);
    stand->extent = fmaxf(stand->extent, 1.06f * span);
    for (int b = 0; b < shape.bends; ++b) {
        const int    stem = b / (shape.rows - 2), row = b % (shape.rows - 2);
        const float* at = stand->rest + 3 * (stem * shape.rows + row);
        for (int d = 0; d < 3; ++d)
            stand->rest_bend[3 * b + d] = at[d] - 2.0f * at[3 + d] + at[6 + d];
    }
    const double swing = 2.0 * DP_PI * (double)kind->sway;
    stand->bend_rate = (float)(swing * swing / lowest_mode(shape.rows - DP_PLANT_HELD));
}

// of two particles, the first in a row that is no higher
static void add_edge(PlantStand* stand, int a, int b, double rate)
{
    const int rows = stand->shape.rows;
    if (b % rows < DP_PLANT_HELD) return;  // and so is a
    double d2 = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double along = (double)stand->rest[3 * b + d] - (double)stand->rest[3 * a + d];
        d2 += along * along;
    }
    PlantEdge* edge = &stand->edge[stand->edges++];
    *edge = (PlantEdge){.a = a, .b = b, .rest = (float)sqrt(d2), .rate = (float)rate};
    edge->share_a = a % rows < DP_PLANT_HELD ? 0.0f : 0.5f;
    edge->share_b = 1.0f - edge->share_a;
}

// across, then diagonals, then stems upward: what comes last holds best. Edges that follow one
// another share no particle, so that a machine can work on several. TRAIL (5)
static void join_edges(PlantStand* stand)
{
    const int    rows = stand->shape.rows, columns = stand->shape.stems_a_sheet;
    const double swing = 2.0 * DP_PI * (double)stand->kind.across, rate = swing * swing;
    for (int odd = 0; odd < 2; ++odd)
        for (int stem = odd; stem < stand->shape.stems; stem += 2)
            for (int r = 0; stem % columns + 1 < columns && r < rows; ++r)
                add_edge(stand, stem * rows + r, (stem + 1) * rows + r, rate);
    for (int odd = 0; odd < 2; ++odd)
        for (int stem = odd; stem < stand->shape.stems; stem += 2)
            for (int r = 0; stem % columns + 1 < columns && r + 1 < rows; ++r) {
                add_edge(stand, stem * rows + r, (stem + 1) * rows + r + 1, 4.0 * rate);
                add_edge(stand, (stem + 1) * rows + r, stem * rows + r + 1, 4.0 * rate);
            }
    stand->near = INFINITY;
    for (int e = 0; e < stand->edges; ++e) {
        const float *a = stand->rest + 3 * stand->edge[e].a,
                    *b = stand->rest + 3 * stand->edge[e].b;
        if (stand->edge[e].b - stand->edge[e].a == rows)
            stand->near = fminf(stand->near, hypotf(b[0] - a[0], b[1] - a[1]));
    }
    for (int r = 1; r + 1 < rows; ++r)
        for (int stem = 0; stem < stand->shape.stems; ++stem)
            add_edge(stand, stem * rows + r, stem * rows + r + 1, 0.0);
}

// cosines of the angles at which a bend wears and breaks; -2 = it never does
static void limits(const PlantStand* stand, int bend, double* wears, double* breaks)
{
    const DpPlantKind* kind = &stand->kind;
    const int          rows = stand->shape.rows, stem = bend / (rows - 2), row = bend % (rows - 2);
    const float*       at = stand->rest + 3 * (stem * rows + row);
    double             dot = 0.0, a2 = 0.0, b2 = 0.0;
    for (int d = 0; d < 3; ++d) {
        const double a = (double)at[3 + d] - (double)at[d],
                     b = (double)at[6 + d] - (double)at[3 + d];
        dot += a * b, a2 += a * a, b2 += b * b;
    }
    const double size = sqrt(a2 * b2);
    const double rest = size > 0.0 ? acos(dp_clamp(dot / size, -1.0, 1.0)) : 0.0;  // phi_0
    const double low = rest + (double)kind->degrade_angle, high = rest + (double)kind->break_angle;
    *wears = low < DP_PI ? cos(low) : -2.0;
    *breaks = high < DP_PI ? cos(high) : -2.0;
}

static void bend_limits(PlantStand* stand)
{
    for (int b = 0; b < stand->shape.bends; ++b)
        limits(stand, b, &stand->limit[2 * b], &stand->limit[2 * b + 1]);
}

void dp_plant_shape_stand(PlantStand* stand)
{
    rest_shape(stand);
    join_edges(stand);
    bend_limits(stand);
}

DpVec3 dp_plant_rest_at(const PlantStand* stand, const PlantBlock* block, int particle, int l)
{
    const int    rows = stand->shape.rows;
    const float *at = stand->rest + 3 * particle,
                *foot = stand->rest + 3 * (particle / rows * rows);
    const double c = (double)block->turn[0][l], s = (double)block->turn[1][l];
    const double x = (double)at[0], y = (double)at[1], fx = (double)foot[0], fy = (double)foot[1];
    const double lift = (double)block->slope[0][l] * (c * fx - s * fy) +
                        (double)block->slope[1][l] * (s * fx + c * fy);
    return dp_vec3((double)block->foot[0][l] + c * x - s * y,
                   (double)block->foot[1][l] + s * x + c * y,
                   (double)block->foot[2][l] + (double)at[2] + lift);
}

// refine/refine.c - bisection of longest edges, in rounds. PEYRAT11 3.2
//
// A round: every triangle that is too coarse marks its base, its longest edge; whoever has a marked
// edge marks its own base, too, until nobody has to; then all with a marked base are halved, and
// halves that have a marked edge again. So long thin triangles become stout ones on the way.
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "refine/refine_inside.h"

#define SLACK 1.02  // of squared lengths: what is wished for, but for rounding, is fine enough

// A triangle while it is cut: its base, the longest edge, goes from the second point to the third.
typedef struct Piece
{
    int   point[3];
    int   edge[3];  // across from each point: the first is the base
    int   source;
    int   turn;          // which corner of the source's order comes first, for given triangles
    float weight[3][3];  // of each point: shares of the source's points
} Piece;

#define MAX_COUNT (INT32_MAX / 2)  // of any array

typedef struct Cutting
{
    DpWishTree* wish;
    Piece*      piece;
    int*        next;  // of each side: the next one on the same edge, -1 = last
    int         pieces;
    DpEdge*     edge;
    int         edges;
    double*     point;
    int*        point_source;
    float (*point_weight)[3];
    int            points, given;
    unsigned char* cut;
    int*           work;  // edges that are marked in this round
    int            works;
    int*           coarse;  // pieces to be looked at
    int            coarses;
} Cutting;

static void enlist(Cutting* cutting, int piece)
{
    for (int k = 0; k < 3; ++k) {
        DpEdge* edge = &cutting->edge[cutting->piece[piece].edge[k]];
        cutting->next[3 * piece + k] = edge->head;
        edge->head = 3 * piece + k;
    }
}

static void strike_off(Cutting* cutting, int piece)
{
    for (int k = 0; k < 3; ++k) {
        int* at = &cutting->edge[cutting->piece[piece].edge[k]].head;
        while (*at != 3 * piece + k) at = &cutting->next[*at];
        *at = cutting->next[3 * piece + k];
    }
}

static DpStatus mark_base(Cutting* cutting, int piece)
{
    const int base = cutting->piece[piece].edge[0];
    if (cutting->edge[base].mid != DP_EDGE_PLAIN) return DP_OK;
    if (!dp_make_room(&cutting->work, (size_t)cutting->works + 1, sizeof *cutting->work))
        return DP_NO_MEMORY;
    cutting->edge[base].mid = DP_EDGE_MARKED;
    cutting->work[cutting->works++] = base;
    return DP_OK;
}

// the bases of all that have a marked edge are marked, until nothing changes
static DpStatus close_marks(Cutting* cutting)
{
    for (int k = 0; k < cutting->works; ++k)
        for (int side = cutting->edge[cutting->work[k]].head; side >= 0;
             side = cutting->next[side]) {
            const DpStatus status = mark_base(cutting, side / 3);
            if (status != DP_OK) return status;
        }
    return DP_OK;
}

// room for a point, three edges and a piece more
static bool fit_one_more(Cutting* cutting)
{
    const size_t pieces = (size_t)cutting->pieces + 1, edges = (size_t)cutting->edges + 3;
    const size_t points = (size_t)cutting->points + 1, fresh = points - (size_t)cutting->given;
    return edges < MAX_COUNT && 3 * pieces < MAX_COUNT &&
           dp_make_room(&cutting->piece, pieces, sizeof *cutting->piece) &&
           dp_make_room(&cutting->next, 3 * pieces, sizeof *cutting->next) &&
           dp_make_room(&cutting->edge, edges, sizeof *cutting->edge) &&
           dp_make_room(&cutting->point, points, 3 * sizeof *cutting->point) &&
           dp_make_room(&cutting->point_source, fresh, sizeof *cutting->point_source) &&
           dp_make_room(&cutting->point_weight, fresh, sizeof *cutting->point_weight);
}

static int new_edge(Cutting* cutting, int a, int b)
{
    cutting->edge[cutting->edges] =
        (DpEdge){{a < b ? a : b, a < b ? b : a}, -1, DP_EDGE_PLAIN, {-1, -1}};
    return cutting->edges++;
}

// halve a marked edge where nobody has yet: a point in its middle, known by the piece's source
static void halve_edge(Cutting* cutting, int at, int source, const float weight[3])
{
    const DpEdge  was = cutting->edge[at];
    const int     mid = cutting->points++;
    const double *a = cutting->point + 3 * (size_t)was.point[0],
                 *b = cutting->point + 3 * (size_t)was.point[1];
    for (int axis = 0; axis < 3; ++axis)
        cutting->point[3 * (size_t)mid + (size_t)axis] = 0.5 * a[axis] + 0.5 * b[axis];
    cutting->point_source[mid - cutting->given] = source;
    memcpy(cutting->point_weight[mid - cutting->given], weight, 3 * sizeof *weight);
    for (int k = 0; k < 2; ++k) {
        const int half = new_edge(cutting, was.point[k], mid);
        cutting->edge[at].half[k] = half;
    }
    cutting->edge[at].mid = mid;
}

static DpStatus remember(Cutting* cutting, int piece)
{
    if (!dp_make_room(&cutting->coarse, (size_t)cutting->coarses + 1, sizeof *cutting->coarse))
        return DP_NO_MEMORY;
    cutting->coarse[cutting->coarses++] = piece;
    return DP_OK;
}

static double edge_squared(const Cutting* cutting, int a, int b)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = cutting->point[3 * (size_t)a + (size_t)axis] -
                         cutting->point[3 * (size_t)b + (size_t)axis];
        sum += d * d;
    }
    return sum;
}

// let a piece's base be its longest edge, of those that are to be halved where there are any
static void choose_base(const Cutting* cutting, Piece* piece)
{
    int    best = 0;
    double longest = -1.0;
    bool   marked = false;
    for (int k = 0; k < 3; ++k) {
        const bool   is_marked = cutting->edge[piece->edge[k]].mid != DP_EDGE_PLAIN;
        const double length =
            edge_squared(cutting, piece->point[(k + 1) % 3], piece->point[(k + 2) % 3]);
        if (is_marked > marked || (is_marked == marked && length > longest)) {
            best = k;
            longest = length;
            marked = is_marked;
        }
    }
    if (best == 0) return;
    const Piece was = *piece;
    for (int k = 0; k < 3; ++k) {
        piece->point[k] = was.point[(k + best) % 3];
        piece->edge[k] = was.edge[(k + best) % 3];
        memcpy(piece->weight[k], was.weight[(k + best) % 3], sizeof was.weight[k]);
    }
}

// halve a piece if its base is marked, and its halves if theirs are; what came of it is remembered
static DpStatus halve(Cutting* cutting, int at)
{
    const int base = cutting->piece[at].edge[0];
    if (cutting->edge[base].mid == DP_EDGE_PLAIN) return remember(cutting, at);
    if (!fit_one_more(cutting)) return DP_NO_MEMORY;
    strike_off(cutting, at);
    const Piece was = cutting->piece[at];
    float       weight[3];
    for (int k = 0; k < 3; ++k) weight[k] = 0.5f * was.weight[1][k] + 0.5f * was.weight[2][k];
    if (cutting->edge[base].mid < 0) halve_edge(cutting, base, was.source, weight);
    const DpEdge on = cutting->edge[base];
    const int    middle = new_edge(cutting, on.mid, was.point[0]);
    const int    second = on.half[was.point[1] != on.point[0]];  // from the second point to mid
    const int    third = on.half[was.point[1] == on.point[0]];
    const int    other = cutting->pieces++;
    cutting->cut[was.source] = 1;
    Piece* piece = &cutting->piece[at];
    *piece = (Piece){
        {on.mid, was.point[0], was.point[1]}, {was.edge[2], second, middle}, was.source, 0, {{0}}};
    memcpy(piece->weight[0], weight, sizeof weight);
    memcpy(piece->weight[1], was.weight[0], sizeof weight);
    memcpy(piece->weight[2], was.weight[1], sizeof weight);
    piece = &cutting->piece[other];
    *piece = (Piece){
        {on.mid, was.point[2], was.point[0]}, {was.edge[1], middle, third}, was.source, 0, {{0}}};
    memcpy(piece->weight[0], weight, sizeof weight);
    memcpy(piece->weight[1], was.weight[2], sizeof weight);
    memcpy(piece->weight[2], was.weight[0], sizeof weight);
    choose_base(cutting, &cutting->piece[at]);
    choose_base(cutting, piece);
    enlist(cutting, at);
    enlist(cutting, other);
    const DpStatus status = halve(cutting, at);
    return status == DP_OK ? halve(cutting, other) : status;
}

// whether an edge, seen from above as maps see it, is longer than is wished for where the piece is
static bool is_coarse(const Cutting* cutting, const Piece* piece)
{
    const double* at[3];
    double        low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, longest = 0.0;
    for (int k = 0; k < 3; ++k) at[k] = cutting->point + 3 * (size_t)piece->point[k];
    for (int k = 0; k < 3; ++k) {
        const double *one = at[k], *other = at[(k + 1) % 3];
        const double  x = other[0] - one[0], y = other[1] - one[1];
        longest = fmax(longest, x * x + y * y);
        for (int axis = 0; axis < 2; ++axis) {
            low[axis] = fmin(low[axis], one[axis]);
            high[axis] = fmax(high[axis], one[axis]);
        }
    }
    const double size = dp_wish_within(cutting->wish, low, high);
    return longest > 2.0 * size * size * SLACK;
}

// one round over the pieces that may be too coarse; *more: whether any was
static DpStatus round_of(Cutting* cutting, bool* more)
{
    cutting->works = 0;
    DpStatus status = DP_OK;
    for (int k = 0; k < cutting->coarses && status == DP_OK; ++k)
        if (is_coarse(cutting, &cutting->piece[cutting->coarse[k]]))
            status = mark_base(cutting, cutting->coarse[k]);
    if (status == DP_OK) status = close_marks(cutting);
    *more = cutting->works > 0;
    cutting->coarses = 0;
    for (int k = 0; k < cutting->works && status == DP_OK; ++k)
        while (cutting->edge[cutting->work[k]].head >= 0 && status == DP_OK)
            status = halve(cutting, cutting->edge[cutting->work[k]].head / 3);
    return status;
}

// which corner lies across from the longest edge
static int apex_of(const Cutting* cutting, const int* face)
{
    int    apex = 0;
    double longest = -1.0;
    for (int k = 0; k < 3; ++k) {
        const double length = edge_squared(cutting, face[(k + 1) % 3], face[(k + 2) % 3]);
        if (length > longest) {
            longest = length;
            apex = k;
        }
    }
    return apex;
}

static DpStatus begin(Cutting* cutting, const double* point, int points, const int* triangle,
                      int triangles)
{
    cutting->points = cutting->given = points;
    cutting->cut = dp_alloc((size_t)triangles + 1, 1);
    int* edge_of = dp_alloc(3 * (size_t)triangles + 1, sizeof *edge_of);
    if (!cutting->cut || !edge_of || !fit_one_more(cutting) ||
        !dp_make_room(&cutting->piece, (size_t)triangles, sizeof *cutting->piece) ||
        !dp_make_room(&cutting->next, 3 * (size_t)triangles, sizeof *cutting->next)) {
        dp_free(edge_of);
        return DP_NO_MEMORY;
    }
    dp_free(cutting->edge);
    cutting->edge = NULL;
    DpStatus status = dp_edges_find(triangle, triangles, edge_of, &cutting->edge, &cutting->edges);
    memcpy(cutting->point, point, 3 * (size_t)points * sizeof *point);
    for (int t = 0; t < triangles && status == DP_OK; ++t) {
        const int apex = apex_of(cutting, triangle + 3 * (size_t)t);
        Piece*    piece = &cutting->piece[t];
        *piece = (Piece){{0}, {0}, t, apex, {{0}}};
        for (int k = 0; k < 3; ++k) {
            const int corner = (apex + k) % 3;
            piece->point[k] = triangle[3 * (size_t)t + (size_t)corner];
            piece->edge[k] = edge_of[3 * (size_t)t + (size_t)corner];
            piece->weight[k][corner] = 1.0f;
        }
        enlist(cutting, t);
        status = remember(cutting, t);
    }
    cutting->pieces = triangles;
    dp_free(edge_of);
    return status;
}

// hand over what was made; corners of triangles that nobody cut keep their order
static DpStatus finish(Cutting* cutting, DpRefined* out)
{
    const size_t count = (size_t)cutting->pieces;
    out->triangle = dp_alloc(3 * count + 1, sizeof *out->triangle);
    out->source = dp_alloc(count + 1, sizeof *out->source);
    out->weight = dp_alloc(9 * count + 1, sizeof *out->weight);
    if (!out->triangle || !out->source || !out->weight) {
        dp_refined_free(out);
        return DP_NO_MEMORY;
    }
    for (size_t t = 0; t < count; ++t) {
        const Piece* piece = &cutting->piece[t];
        out->source[t] = piece->source;
        for (int k = 0; k < 3; ++k) {
            const int to = (k + piece->turn) % 3;
            out->triangle[3 * t + (size_t)to] = piece->point[k];
            memcpy(out->weight + 9 * t + 3 * (size_t)to, piece->weight[k], sizeof piece->weight[k]);
        }
    }
    out->triangles = cutting->pieces;
    out->point = cutting->point;
    out->points = cutting->points;
    out->given = cutting->given;
    out->point_source = cutting->point_source;
    out->point_weight = &cutting->point_weight[0][0];
    out->cut = cutting->cut;
    cutting->point = NULL;
    cutting->point_source = NULL;
    cutting->point_weight = NULL;
    cutting->cut = NULL;
    return DP_OK;
}

DpStatus dp_refine(const double* point, int points, const int* triangle, int triangles,
                   const DpWishes* wishes, int max_triangles, DpRefined* out)
{
    *out = (DpRefined){0};
    if (points < 0 || triangles < 0 || points > INT32_MAX / 4 || triangles > INT32_MAX / 4)
        return DP_BAD_ARGUMENT;
    for (size_t k = 0; k < 3 * (size_t)triangles; ++k)
        if (triangle[k] < 0 || triangle[k] >= points) return DP_BAD_ARGUMENT;
    for (size_t k = 0; k < 3 * (size_t)points; ++k)
        if (!isfinite(point[k])) return DP_BAD_ARGUMENT;
    Cutting  cutting = {0};
    DpStatus status = dp_wish_create(wishes, &cutting.wish);
    if (status == DP_OK) status = begin(&cutting, point, points, triangle, triangles);
    bool more = true;
    while (status == DP_OK && more && cutting.pieces < max_triangles)
        status = round_of(&cutting, &more);
    if (status == DP_OK) status = finish(&cutting, out);
    if (status == DP_OK) out->valid = !more;
    dp_wish_destroy(cutting.wish);
    dp_free(cutting.edge);
    dp_free(cutting.piece);
    dp_free(cutting.next);
    dp_free(cutting.point);
    dp_free(cutting.point_source);
    dp_free(cutting.point_weight);
    dp_free(cutting.cut);
    dp_free(cutting.work);
    dp_free(cutting.coarse);
    return status;
}

void dp_refined_free(DpRefined* refined)
{
    dp_free(refined->point);
    dp_free(refined->point_source);
    dp_free(refined->point_weight);
    dp_free(refined->triangle);
    dp_free(refined->source);
    dp_free(refined->weight);
    dp_free(refined->cut);
    *refined = (DpRefined){0};
}

// refine/refine_edges.c - the edges of triangles, by their two points.
#include "base/alloc.h"
#include "refine/refine_inside.h"

// the place of a table, of a power of two, where an edge is or would be
static size_t place_of(const int* table, size_t places, const DpEdge* edge, int low, int high)
{
    uint64_t hash = ((uint64_t)(uint32_t)low << 32 | (uint32_t)high) * UINT64_C(0x9E3779B97F4A7C15);
    hash ^= hash >> 29;
    size_t at = (size_t)hash & (places - 1);
    while (table[at] != 0) {
        const DpEdge* there = &edge[table[at] - 1];
        if (there->point[0] == low && there->point[1] == high) break;
        at = (at + 1) & (places - 1);
    }
    return at;
}

DpStatus dp_edges_find(const int* triangle, int triangles, int* of, DpEdge** edges, int* count)
{
    const size_t sides = 3 * (size_t)triangles;
    size_t       places = 64;
    while (places < 2 * sides) places *= 2;
    int*    table = dp_alloc(places, sizeof *table);  // number of an edge, from 1
    DpEdge* edge = dp_alloc(sides + 1, sizeof *edge);
    *count = 0;
    if (!table || !edge) {
        dp_free(table);
        dp_free(edge);
        return DP_NO_MEMORY;
    }
    for (size_t side = 0; side < sides; ++side) {
        const int*   face = triangle + (side - side % 3);
        const int    k = (int)(side % 3);
        const int    a = face[(k + 1) % 3], b = face[(k + 2) % 3];
        const int    low = a < b ? a : b, high = a < b ? b : a;
        const size_t at = place_of(table, places, edge, low, high);
        if (table[at] == 0) {
            edge[*count] = (DpEdge){{low, high}, -1, DP_EDGE_PLAIN, {-1, -1}};
            table[at] = ++*count;
        }
        of[side] = table[at] - 1;
    }
    dp_free(table);
    *edges = edge;
    return DP_OK;
}

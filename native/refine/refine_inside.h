// refine/refine_inside.h - what the files of this room share.
#pragma once
#include <stdint.h>

#include "refine/refine.h"

// An edge: who has it, and what it was halved into.
typedef struct DpEdge
{
    int point[2];  // the lower first
    int head;      // the first side that lies on it, 3 * triangle + corner across; -1: none
    int mid;       // the point in its middle, or one of the two below
    int half[2];   // the edges it was halved into, from either of its points
} DpEdge;

#define DP_EDGE_PLAIN (-1)   // it is not to be halved
#define DP_EDGE_MARKED (-2)  // it is, and has no point in its middle yet

// The edges of triangles: three indices into *edges a triangle, each across from the corner of its
// number, into `of`. More than two triangles may have an edge. *edges comes of dp_alloc.
DpStatus dp_edges_find(const int* triangle, int triangles, int* of, DpEdge** edges, int* count);

// Wishes in squares that double from level to level, so that one look at four tells for any box.
typedef struct DpWishTree DpWishTree;
DpStatus                  dp_wish_create(const DpWishes* wishes, DpWishTree** out);
void                      dp_wish_destroy(DpWishTree* tree);
// The least size that is wished for in or close to a box; INFINITY where nothing is.
double dp_wish_within(const DpWishTree* tree, const double low[2], const double high[2]);

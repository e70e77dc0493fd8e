// plants/plant_laid.h - what stems looked like when soles laid them.
#pragma once
#include "plants/plant_inside.h"

// Of one block.
typedef struct LaidBlock
{
    float*   segment[3];  // (pieces of all stems, lanes) [m]
    float*   share;       // how low it lay of what the lean said (stems, lanes)
    uint8_t* laid;        // did anything lay it? (stems, lanes)
} LaidBlock;

// Of all stands. Start from {0}.
typedef struct LaidStems
{
    LaidBlock*** stand;  // blocks of each stand; NULL = never laid
    int          stands;
} LaidStems;

struct DpPlantDisplay
{
    const DpPlants* plants;
    DpStemLeanAt    lean_at;
    const void*     context;  // of lean_at
    LaidStems       laid;
};

// nothing was laid yet; NULL without memory
LaidBlock* dp_plant_laid_create(const DpPlantShape* shape);
// stands that have come since; false without memory
bool dp_plant_laid_fit(LaidStems* laid, const DpPlants* plants);
void dp_plant_laid_drop(LaidStems* laid, const DpPlants* plants);

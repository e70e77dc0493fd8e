// desire_path.h - start here: the core of Desire Path, what a walking body does to the ground.
//
//   recording          walker                  imprint        soil                    maps
//   DpGait  ------->   contact, forces  ---->  cells under -> pressed, pushed aside, -> EXR
//   (who walked how)   TRAIL (3) (4)           the sole       at rest TRAIL (9)-(16)   TRAIL (17)
//                                                  ^              ^   ^
//                                                  +-- terrain ---+   +-- plants bend, wear, hold
//                                        sparse tiles, patches lent       the soil TRAIL (5)-(8)
//
// sim/ runs one step in the paper's order and is the only place where rooms meet. The frame and the
// units are said in base/types.h. Tags such as `TRAIL (13)` name equations of
//   TRAIL   Alvarado et al. 2024, doi 10.1007/s00371-024-03506-z
//   SOFT22  Alvarado et al. 2022, doi 10.3389/frvir.2022.801856
#pragma once
#include "base/status.h"
#include "base/types.h"
#include "walker/walker.h"
#include "motion/motion.h"
#include "imprint/imprint.h"
#include "soil/soil.h"
#include "carry/carry.h"
#include "plants/plants.h"
#include "grass/grass.h"
#include "terrain/terrain.h"
#include "maps/maps.h"
#include "refine/refine.h"
#include "paths/paths.h"
#include "spray/spray.h"
#include "sim/sim.h"

// sim/sim_state.h - the layout of a state, which sim_state.c writes and sim_resume.c reads.
//
//   "sim "  which ground and walkers these are, the next step, limbs in their stances, what presses
//   then what the rooms keep of themselves: terrain and, on planted ground, plants and grass
#pragma once
#include "sim/sim_inside.h"

#define DP_STATE_NAME "sim "
#define DP_STATE_VERSION \
    5  // 4 lacks what soles sheared, 3 what they slid over, 2 prints that slide, 1 walls and springs
#define DP_STATE_SHOWN "show"  // whether it is remembered how soles laid the stems
#define DP_STATE_SHOWN_VERSION 1
#define DP_STATE_CARRIED "crry"  // what sticks to the limbs, where soil does
#define DP_STATE_CARRIED_VERSION 1

// What another simulation has to share with this one to go on from its state.
void dp_sim_identity(const DpSim* sim, double number[8]);

// Time of a sample of its motion, 0 without one [s].
double dp_sim_time(const DpSim* sim, int sample);

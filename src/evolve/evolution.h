/* The inside of an evolution, for the files that make it up. */
#ifndef FG__EVOLUTION_H
#define FG__EVOLUTION_H

#include <time.h>

#include "evolve/components.h"
#include "evolve/stepper.h"

struct fg_evolution {
  fg_context *context;
  fg_evolution_options options; /* with the defaults filled in */
  fg_mesh_info info;
  fg__mesh mesh;
  fg__tensor tensor;
  fg__stepper stepper;
  fg__components components;
  size_t nodes, cells;
  float *plain;       /* u without ghosts, x fastest */
  float *plain_mass;  /* relative mass of each node, halved at borders */
  double debris_area; /* in cells */
  double area_fraction;
  int clusters;
  bool counting; /* nucleation is over */
  struct timespec start;
  double earlier_seconds; /* spent before a resumed evolution was created */
  /* Of the field, and of the initial density when one was given (else 0). */
  uint64_t field_fingerprint, initial_fingerprint;
};

double fg__evolution_seconds(const fg_evolution *evolution);

/* The state as a step; it took these cycles and rejected attempts. */
fg_step fg__evolution_describe(const fg_evolution *evolution, int cycles, int rejected);

#endif

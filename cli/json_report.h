/* run.json: what a run was and did (past_run.h reads it). */
#ifndef JSON_REPORT_H
#define JSON_REPORT_H

#include "drawing.h"

enum { MAX_MESH_CHANGES = 16 };

/* A halving of the mesh: the state in which it was made, what it made of the energy, and
 * the cells since. */
typedef struct mesh_change {
  long step;
  double time, energy_before, energy_after;
  int clusters, cells[3];
} mesh_change;

typedef struct run_facts {
  const cli_settings *settings;
  const fg_field *field;
  fg_mesh_info mesh; /* the first */
  mesh_change change[MAX_MESH_CHANGES];
  int change_count;
  cli_drawing *drawing;
  const char *ended; /* "scales", "time", "steps", "stationary", "interrupted" */
  int time_count, level_count; /* of the input; 0: not known */
  long accepted, rejected;
  double mass_drift;
  bool energy_monotone; /* in steps, between changes of the mesh */
  double seconds_read, seconds_evolve, seconds_total;
  int ranks;
  fg_traffic traffic[FG_ACTIVITIES], most_traffic[FG_ACTIVITIES];
} run_facts;

/* Writes run.json. Returns an exit code. */
int report_write(const char *path, const run_facts *facts);

#endif

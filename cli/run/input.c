#include "run/input.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "alternatives.h"
#include "build_features.h"
#include "option/table.h"
#include "option/validation.h"
#include "ranks.h"

/* Reads a slab, unless icons need the whole density (snapshot.c). */
int input_read(cli_run *run)
{
  const run_settings *settings = run->settings;
  const bool whole =
      settings->tolerance > 0.0 || settings->picture.tint || settings->picture.background;
  const int slab = whole ? 0 : ranks_number(), slabs = whole ? 1 : ranks_count();
  progress_stage(&run->progress, "reading");
  const fg_read_options reading = settings_reading(&settings->reading);
  fg_status status = FG_STATUS_OK;
  if (!run->input)
    status = fg_input_open(&run->input, run->context, settings->reading.input, &reading);
  if (!status)
    status = fg_input_field(&run->field, run->context, run->input, reading.time,
                            reading.level, slab, slabs);
  progress_wipe(&run->progress);
  if (status)
    return complain_of_field(run->context, status, run->input, &settings->reading);
  run->facts.field = run->field;
  int dimension = fg_field_contents(run->field)->dimension;
  int code = refuse_other_dimension("run", &settings->picture, dimension,
                                    settings->reading.input);
  return code ? code
              : refuse_undrawable(settings->formats, settings->picture.background != 0,
                                  dimension == 3);
}

static void print_choice(const char *file, const char *kind, int index, int count,
                         const char *words)
{
  char text[CLEAN_BYTES];
  if (count > 1)
    fprintf(stderr, "flowgrain: %s: %s %d of 0 to %d%s%s\n", input_name(file), kind,
            index, count - 1, words ? ": " : "", clean_text(text, words ? words : ""));
}

static void print_choices(cli_run *run)
{
  const run_settings *settings = run->settings;
  const fg_field_arrays *field = fg_field_contents(run->field);
  reading_facts *facts = &run->facts.reading;
  *facts = (reading_facts){.settings = &settings->reading, .field = run->field};
  reading_find(facts, run->input);
  if (settings->quiet)
    return;
  print_choice(settings->reading.input, "time", settings->reading.time, facts->times,
               field->time);
  print_choice(settings->reading.input, "level", settings->reading.level, facts->levels,
               field->level);
}

int input_join(cli_run *run)
{
  fg_status status = fg_field_join(run->context, run->field);
  if (status)
    return complain_of_field(run->context, status, run->input, &run->settings->reading);
  if (ranks_leader()) {
    print_choices(run);
    report_doubts(run->settings->reading.input, run->field);
  }
  fg_input_close(run->input);
  run->input = NULL;
  return EXIT_DONE;
}

static const char *const scheme_names[] = {"BDF2", "implicit Euler", "theta"};

void input_print_cells(int dimension, const int cells[3])
{
  fprintf(stderr, "mesh %d x %d", cells[0], cells[1]);
  if (dimension == 3)
    fprintf(stderr, " x %d", cells[2]);
  fprintf(stderr, " cells");
}

static void print_mesh(const fg_mesh_info *mesh, int scheme)
{
  fprintf(stderr, "flowgrain: ");
  input_print_cells(mesh->dimension, mesh->cells);
  fprintf(stderr,
          " (%" PRId64 " active), a = %g, coverage %g, gamma %g, %s scheme, %s kernel\n",
          mesh->active_cells, mesh->anisotropy, mesh->coverage, mesh->gamma,
          scheme_names[scheme], mesh->kernel);
}

/* Reads the file of --energy. Returns an exit code, the same on all ranks. */
static int read_energy(fg_tensors **out, const cli_run *run)
{
  const char *path = run->settings->evolution.energy;
  *out = NULL;
  if (energy_place(path) >= 0)
    return EXIT_DONE;
  const fg_status status = fg_tensors_read(out, run->context, path, run->field);
  return ranks_agree(status ? complain_of(run->context, status, path) : EXIT_DONE);
}

int input_create_scales(cli_run *run, fg_run_options *options)
{
  int code = read_energy(&run->tensors, run);
  if (code)
    return code;
  if (run->tensors)
    options->evolution.law = fg_tensors_law(run->tensors);
  fg_status status = fg_run_create(&run->scales, run->context, run->field, options);
  if (status)
    return complain_of(run->context, status, run->settings->reading.input);
  run->facts.mesh = *fg_evolution_mesh(fg_run_evolution(run->scales));
  if (run->settings->verbose && ranks_leader())
    print_mesh(&run->facts.mesh, run->settings->evolution.scheme);
  return EXIT_DONE;
}

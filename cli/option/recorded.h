/* Options on which results depend, as run.json and checkpoints record them. */
#ifndef OPTION_RECORDED_H
#define OPTION_RECORDED_H

#include "option/settings.h"

struct cJSON;

/* A JSON object with the given options as texts that can be given again: {"seed": "2",
 * "clusters": "60,20"}. NULL without memory. */
struct cJSON *options_record(const run_settings *settings);

/* Whether an earlier run had the same options. Otherwise prints the first difference with
 * both values. */
bool options_match(const struct cJSON *earlier, const run_settings *settings);

/* Adds which files were read: path and absolute of the input, vars_from and mesh_from. */
void files_record(struct cJSON *input, const reading_settings *reading);

/* Whether they are those of an earlier run's report, the same by any path. Otherwise
 * prints an error, which names the folder. */
bool files_match(const struct cJSON *input, const reading_settings *reading,
                 const char *folder);

#endif

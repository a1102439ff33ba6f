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

#endif

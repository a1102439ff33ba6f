/* The options that a result depends on, as run.json and checkpoints record them. */
#ifndef OPTION_RECORDED_H
#define OPTION_RECORDED_H

#include "option/settings.h"

struct cJSON;

/* An object with a text for every such option of `run` that was given, as it could be
 * again: {"seed": "2", "clusters": "60,20"}. NULL without memory. */
struct cJSON *options_record(const run_settings *settings);

/* Whether an earlier run had the same options; else complains, naming the first option
 * that differs, with both values. */
bool options_match(const struct cJSON *earlier, const run_settings *settings);

#endif

/* What the command line said that a result depends on. */
#ifndef OPTION_RECORDED_H
#define OPTION_RECORDED_H

#include "option/settings.h"

struct cJSON;

/* An object with a text for every such option of `run` that was said, as it could be said
 * again: {"seed": "2", "clusters": "60,20"}. NULL without memory. */
struct cJSON *said_options(const run_settings *settings);

/* Whether an earlier run was told the same; else complains, naming the first option that
 * differs, with both values. */
bool said_the_same(const struct cJSON *earlier, const run_settings *settings);

#endif

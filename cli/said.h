/* What the command line said that a result depends on. */
#ifndef SAID_H
#define SAID_H

#include "program.h"

struct cJSON;

/* An object with a text for every such option of `run` that was said, as it could be said
 * again: {"seed": "2", "clusters": "60,20"}. NULL without memory. */
struct cJSON *said_options(const cli_settings *settings);

/* Whether an earlier run was told the same; else complains, naming the first option that
 * differs, with both values. */
bool said_the_same(const struct cJSON *earlier, const cli_settings *settings);

#endif

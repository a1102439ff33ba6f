/* Features that a build may lack. */
#ifndef FG__FEATURE_H
#define FG__FEATURE_H

#include "base/context.h"

/* Says of `what`, a file or a kind of work, that it needs a feature which this build
 * lacks. Returns UNSUPPORTED. */
fg_status fg__fail_absent(fg_context *context, const char *what, fg_feature feature);

#endif

/* What the methods share: the prepared rival, and one function a method. */
#ifndef FG__RIVAL_METHOD_H
#define FG__RIVAL_METHOD_H

#include "rival/domain.h"

struct fg_rival {
  fg_context *context;
  fg_rival_options options;
  fg__domain domain;
};

/* Fill a list with about `count` icons. MEMORY, STOPPED. */
fg_status fg__rival_hedgehog(fg_icons *icons, const fg_rival *rival, int count);
fg_status fg__rival_grid_curved(fg_icons *icons, const fg_rival *rival, int count);

#endif

/* The colour key under a texture: which colour stands for which speed. */
#ifndef FG__TEXTURE_KEY_H
#define FG__TEXTURE_KEY_H

#include "picture/page/page.h"

/* Lays a key out on a page whose frame is the texture and whose width is the frame's,
 * below the frame: page->height grows by what it needs. Too narrow a page gets none. */
void fg__texture_key_place(fg__page *page, const double range[2], const char *units);

#endif

/* What the server gives: the page of a run; while it goes on a page that follows it, its
 * state, the density as it evolved and the pictures of its scales. */
#ifndef VIEW_PAGES_H
#define VIEW_PAGES_H

#include "view/child.h"
#include "view/server.h"

typedef struct view_pages {
  const cli_child *child; /* its folder; a run in a folder has ended long ago */
  const char *input;
} view_pages;

/* A give_answer, `data` being view_pages: nothing else of the run's folder. */
void pages_give(cli_answer *out, const char *name, void *pages);

/* The page that follows a run: live.html, as CMake makes it a string. */
extern const size_t view_live_page_size;
extern const unsigned char view_live_page[];

#endif

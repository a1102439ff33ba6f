/* What the methods share: the prepared rival, and one function a method. */
#ifndef FG__RIVAL_METHOD_H
#define FG__RIVAL_METHOD_H

#include "rival/cluster/merge_tree.h"

struct fg_rival {
  fg_context *context;
  fg_rival_options options;
  fg__domain domain;
  fg__merge_tree tree; /* discrete */
};

/* Divide the domain: label as fg__clusters_draw takes it. MEMORY, STOPPED. */
fg_status fg__rival_discrete(const fg_rival *rival, int count, int *label, int *found,
                             int *left_out);
fg_status fg__rival_discrete_prepare(fg_rival *rival);
fg_status fg__rival_top_down(const fg_rival *rival, int count, int *label, int *found,
                             int *left_out);

/* Fill a list with `count` icons, or about as many. MEMORY, STOPPED. */
fg_status fg__rival_hedgehog(fg_icons *icons, const fg_rival *rival, int count);
fg_status fg__rival_grid_curved(fg_icons *icons, const fg_rival *rival, int count);
fg_status fg__rival_streamlines(fg_icons *icons, const fg_rival *rival, int count);
fg_status fg__rival_voronoi(fg_icons *icons, const fg_rival *rival, int count);
fg_status fg__rival_k_means(fg_icons *icons, const fg_rival *rival, int count);
fg_status fg__rival_farthest(fg_icons *icons, const fg_rival *rival, int count);
fg_status fg__rival_random(fg_icons *icons, const fg_rival *rival, int count);

#endif

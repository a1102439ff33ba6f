/* The commands. Each takes its settings and returns an exit code. */
#ifndef COMMAND_COMMAND_H
#define COMMAND_COMMAND_H

int command_run(const void *run_settings);
int command_draw(const void *draw_settings);
int command_texture(const void *texture_settings);
int command_brush(const void *brush_settings);
int command_info(const void *info_settings);
int command_synth(const void *synth_settings);
int command_rival(const void *rival_settings);
int command_score(const void *score_settings);
int command_gallery(const void *gallery_settings);
int command_view(const void *view_settings);

#endif

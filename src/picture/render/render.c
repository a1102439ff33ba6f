#include "picture/render/render.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/threads.h"
#include "picture/render/shade.h"

/* A pixel at an edge is drawn finely when a level of a neighbour, of 255, differs by
 * more; one within a surface when levels bend by more from neighbour to neighbour. */
enum { TOLERANCE = 4, BEND = 8 };

/* In smaller pictures arrows are as thin as pixels: all are drawn finely. */
enum { SMALL_PICTURE = 400 * 400 };

/* Layers of transparent surfaces that are told from others. */
enum { MOST_LAYERS = 63 };

/* Room of one thread for a band. */
typedef struct workspace {
  fg__face_at *middle; /* [FG__BAND][width] */
  int *chosen;         /* likewise: numbers of pixels that are drawn finely, or -1 */
  fg__face_at *sample; /* of those */
  size_t sample_capacity;
  fg__layers layers;
  uint32_t *marks;
} workspace;

typedef struct job {
  const fg__rendering *about;
  fg_context *context;
  fg__geometry geometry;
  fg__view view;
  fg__shadow shadow;
  fg__shading shading;
  uint32_t *image, *coarse; /* coarse: drawn by the pixels' middles */
  int *seen;                /* what is there, and behind how many layers */
  int stride;
  workspace *workspace; /* of each thread */
  atomic_int next_band;
  atomic_bool stopped, failed; /* failed: no memory */
} job;

/* Where the layers of a point lie. */
static void set_layers(fg__shade_at *p, const fg__layers *layers, int number)
{
  p->layer = layers->layer + layers->first[number];
  p->layers = layers->first[number + 1] - layers->first[number];
}

/* Samples of a pixel that see the same triangle behind the same layers: they are shaded
 * once, in their middle. */
typedef struct group {
  int face, share, count;
  double x, y; /* sums */
  const fg__face_at *nearest;
} group;

/* Groups the samples of a pixel; what is behind the arrows makes a group of each sample.
 * Returns how many there are. */
static int group_samples(const fg__face_at sample[FG__SAMPLES], const fg__layers *layers,
                         int pixel, group out[FG__SAMPLES])
{
  int count = 0;
  for (int s = 0; s < FG__SAMPLES; ++s) {
    int number = FG__SHARES * pixel + s / FG__SHARING, at = 0;
    int share = layers->first[number + 1] > layers->first[number] ? s / FG__SHARING : -1;
    while (at < count && (sample[s].face < 0 || out[at].face != sample[s].face ||
                          out[at].share != share))
      ++at;
    if (at == count)
      out[count++] = (group){sample[s].face, share, 0, 0.0, 0.0, &sample[s]};
    ++out[at].count;
    out[at].x += fg__sample_place[s][0];
    out[at].y += fg__sample_place[s][1];
  }
  return count;
}

static uint32_t draw_finely(const job *j, const workspace *w, int pixel, int x, int y)
{
  fg__light sum = {0};
  group groups[FG__SAMPLES] = {{0}};
  fg__haze ground[FG__SHARES]; /* before what is behind the arrows */
  for (int n = 0; n < FG__SHARES; ++n)
    ground[n].left = -1.0;
  int count = group_samples(&w->sample[(ptrdiff_t)pixel * FG__SAMPLES], &w->layers, pixel,
                            groups);
  for (int n = 0; n < count; ++n) {
    const group *g = &groups[n];
    fg__shade_at p = {
        .x = x + g->x / g->count, .y = y + g->y / g->count, .nearest = g->nearest};
    if (g->share >= 0)
      set_layers(&p, &w->layers, FG__SHARES * pixel + g->share);
    fg__haze own = {.left = -1.0};
    fg__light light = fg__shade_point(
        &j->shading, &p, g->face < 0 && g->share >= 0 ? &ground[g->share] : &own);
    double weight = (double)g->count / FG__SAMPLES;
    sum.red += weight * light.red;
    sum.green += weight * light.green;
    sum.blue += weight * light.blue;
    sum.alpha += weight * light.alpha;
  }
  return fg__light_pixel(&j->shading.tones, sum, j->about->transparent);
}

static int level_of(uint32_t pixel, int channel)
{
  return (int)(pixel >> 8 * channel & 255U);
}

static bool differ(uint32_t one, uint32_t other)
{
  for (int k = 0; k < 4; ++k)
    if (abs(level_of(one, k) - level_of(other, k)) > TOLERANCE)
      return true;
  return false;
}

/* Whether levels bend from a pixel through the next to the third. */
static bool bend(uint32_t one, uint32_t middle, uint32_t other)
{
  for (int k = 0; k < 4; ++k)
    if (abs(level_of(one, k) - 2 * level_of(middle, k) + level_of(other, k)) > BEND)
      return true;
  return false;
}

/* Whether one colour in a pixel's middle will not do for it: neighbours show something
 * else and look otherwise, or the same surface in colours whose mean is not there. */
static bool is_uneven(const job *j, int x, int y)
{
  static const int way[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
  int wide = j->about->width, high = j->about->height;
  ptrdiff_t own = (ptrdiff_t)y * wide + x;
  for (int n = 0; n < 4; ++n) {
    uint32_t level[2] = {j->coarse[own], j->coarse[own]};
    bool same = true;
    for (int side = 0; side < 2; ++side) {
      int i = x + (side ? way[n][0] : -way[n][0]),
          k = y + (side ? way[n][1] : -way[n][1]);
      if (i < 0 || i >= wide || k < 0 || k >= high)
        continue;
      ptrdiff_t at = (ptrdiff_t)k * wide + i;
      level[side] = j->coarse[at];
      same = same && j->seen[at] == j->seen[own];
    }
    if (level[0] == j->coarse[own] && level[1] == j->coarse[own])
      continue;
    if (same ? bend(level[0], j->coarse[own], level[1])
             : differ(level[0], j->coarse[own]) || differ(level[1], j->coarse[own]))
      return true;
  }
  return false;
}

/* Draws the middles of a band's pixels. */
static bool draw_coarsely(job *j, workspace *w, int band)
{
  int width = j->about->width, top = band * FG__BAND;
  fg__view_middles(&j->view, band, w->middle);
  if (!fg__view_layers(&j->view, band, &w->layers))
    return false;
  for (int n = 0; n < FG__BAND * width && top + n / width < j->about->height; ++n) {
    fg__shade_at p = {
        .x = n % width + 0.5, .y = top + n / width + 0.5, .nearest = &w->middle[n]};
    fg__haze own = {.left = -1.0};
    set_layers(&p, &w->layers, n);
    ptrdiff_t at = (ptrdiff_t)top * width + n;
    j->coarse[at] = fg__light_pixel(
        &j->shading.tones, fg__shade_point(&j->shading, &p, &own), j->about->transparent);
    j->seen[at] =
        p.seen * (MOST_LAYERS + 1) + (p.layers < MOST_LAYERS ? p.layers : MOST_LAYERS);
  }
  return true;
}

/* Numbers the pixels of a band that are drawn finely; returns how many. */
static int choose_pixels(const job *j, workspace *w, int band)
{
  int width = j->about->width, height = j->about->height, count = 0;
  bool small = width * height < SMALL_PICTURE;
  for (int n = 0; n < FG__BAND * width; ++n) {
    int y = band * FG__BAND + n / width;
    w->chosen[n] = -1;
    if (y < height && (small || is_uneven(j, n % width, y)))
      w->chosen[n] = count++;
  }
  return count;
}

/* Draws a band into the image. */
static bool draw_band(job *j, workspace *w, int band)
{
  int width = j->about->width, top = band * FG__BAND;
  int count = choose_pixels(j, w, band);
  if (!fg__grow((void **)&w->sample, &w->sample_capacity, (size_t)count * FG__SAMPLES + 1,
                sizeof *w->sample))
    return false;
  fg__view_samples(&j->view, band, w->chosen, count, w->sample);
  if (!fg__view_sample_layers(&j->view, band, w->chosen, count, &w->layers))
    return false;
  for (int n = 0; n < FG__BAND * width && top + n / width < j->about->height; ++n) {
    int x = n % width, y = top + n / width;
    j->image[(ptrdiff_t)y * j->stride + x] = w->chosen[n] < 0
                                                 ? j->coarse[(ptrdiff_t)y * width + x]
                                                 : draw_finely(j, w, w->chosen[n], x, y);
  }
  return true;
}

static bool draw_shadows(job *j, workspace *w, int band)
{
  fg__shadow_fill(&j->shadow, band, w->marks);
  return true;
}

/* Gives bands out until there are none or the work is stopped; `draw` makes one. */
static void share_bands(job *j, const fg__thread *thread, int bands,
                        bool (*draw)(job *j, workspace *w, int band))
{
  for (;;) {
    int band = atomic_fetch_add(&j->next_band, 1);
    if (band >= bands || atomic_load(&j->stopped) || atomic_load(&j->failed))
      return;
    if (!draw(j, &j->workspace[thread->index], band))
      atomic_store(&j->failed, true);
    if (thread->index == 0 && fg__check_stop(j->context))
      atomic_store(&j->stopped, true);
  }
}

static void work_on_shadows(void *argument, const fg__thread *thread)
{
  job *j = argument;
  share_bands(j, thread, j->shadow.bands.count, draw_shadows);
}

static void work_coarsely(void *argument, const fg__thread *thread)
{
  job *j = argument;
  share_bands(j, thread, j->view.solid.count, draw_coarsely);
}

static void work_finely(void *argument, const fg__thread *thread)
{
  job *j = argument;
  share_bands(j, thread, j->view.solid.count, draw_band);
}

static fg_status make_workspaces(job *j, int members)
{
  size_t band = (size_t)FG__BAND * (size_t)j->about->width;
  size_t texels = (size_t)FG__BAND * (size_t)j->shadow.size[0];
  size_t pixels = (size_t)j->about->width * (size_t)j->about->height;
  j->coarse = fg__allocate(pixels, sizeof *j->coarse);
  j->seen = fg__allocate(pixels, sizeof *j->seen);
  j->workspace = fg__allocate((size_t)members, sizeof *j->workspace);
  bool good = j->coarse && j->seen && j->workspace;
  for (int n = 0; n < members && good; ++n) {
    workspace *w = &j->workspace[n];
    w->middle = fg__allocate(band, sizeof *w->middle);
    w->chosen = fg__allocate(band, sizeof *w->chosen);
    w->marks = fg__allocate(texels, sizeof *w->marks);
    good = w->middle && w->chosen && w->marks;
  }
  if (good)
    return FG_STATUS_OK;
  return fg__fail_memory(j->context, "a picture", pixels * 2 * sizeof *j->coarse);
}

static void free_workspaces(job *j, int members)
{
  for (int n = 0; n < members && j->workspace; ++n) {
    workspace *w = &j->workspace[n];
    free(w->middle);
    free(w->chosen);
    free(w->marks);
    free(w->sample);
    fg__layers_clear(&w->layers);
  }
  free(j->workspace);
  free(j->coarse);
  free(j->seen);
}

/* Runs one of the steps on all threads. */
static fg_status run(job *j, fg__threads *threads, fg__threads_work *work)
{
  atomic_store(&j->next_band, 0);
  fg__threads_run(threads, work, j);
  if (atomic_load(&j->failed))
    return fg__fail_memory(j->context, "a picture", (size_t)j->about->width);
  return fg__check_stop(j->context);
}

static fg_status prepare(job *j)
{
  fg__shading_make(&j->shading, j->about, &j->view, &j->shadow);
  fg_status status = fg__geometry_make(&j->geometry, j->context, j->about);
  if (!status)
    status = fg__view_make(&j->view, j->context, j->about, &j->geometry);
  if (!status)
    status = fg__shadow_make(&j->shadow, j->context, j->about, &j->geometry);
  return status;
}

static fg_status draw_all(job *j, fg__threads *threads)
{
  fg_status status = run(j, threads, work_on_shadows);
  if (!status)
    status = run(j, threads, work_coarsely);
  if (!status)
    status = run(j, threads, work_finely);
  return status;
}

fg_status fg__render(fg_context *context, const fg__rendering *rendering, uint32_t *image,
                     int stride)
{
  job *j = fg__allocate(1, sizeof *j);
  fg__threads *threads = NULL;
  if (!j)
    return fg__fail_memory(context, "a picture", sizeof *j);
  *j = (job){.about = rendering, .context = context, .image = image, .stride = stride};
  fg_status status = prepare(j);
  if (!status)
    status = fg__threads_create(&threads, context, rendering->threads);
  if (!status)
    status = make_workspaces(j, fg__threads_count(threads));
  if (!status)
    status = draw_all(j, threads);
  free_workspaces(j, fg__threads_count(threads));
  fg__threads_destroy(threads);
  fg__shadow_clear(&j->shadow);
  fg__view_clear(&j->view);
  fg__geometry_clear(&j->geometry);
  free(j);
  return status;
}

#include "icon/icons.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* One block an icon, its points and lines behind it, so that a borrowed fg_icon stays
 * where it is while the list grows. */
typedef struct entry {
  fg_icon icon;
  double points[][3];
} entry;

struct fg_icons {
  entry **entries;
  size_t count, capacity;
  int clusters, dropped;
  int next_id;      /* 0: they were not placed */
  char *projection; /* NULL: of no map */
  bool has_score;
  fg_score score;
  fg_critical_points *critical; /* NULL: none */
};

fg_status fg__icons_create_empty(fg_icons **out, fg_context *context)
{
  *out = fg__allocate(1, sizeof **out);
  if (!*out)
    return fg__fail_memory(context, "the list of icons", sizeof **out);
  return FG_STATUS_OK;
}

void fg_icons_destroy(fg_icons *icons)
{
  if (!icons)
    return;
  for (size_t i = 0; i < icons->count; i++)
    free(icons->entries[i]);
  free(icons->entries);
  free(icons->projection);
  fg_critical_points_destroy(icons->critical);
  free(icons);
}

/* Copies a line behind what the entry holds already; returns where it lies. */
static const double (*add_line(entry *added, size_t *used, const double (*line)[3],
                               int count))[3]
{
  if (!line || count < 1)
    return NULL;
  memcpy(added->points + *used, line, (size_t)count * sizeof *line);
  *used += (size_t)count;
  return (const double(*)[3])(added->points + *used - count);
}

fg_status fg__icons_add(fg_icons *icons, fg_context *context, const fg_icon *icon)
{
  if (icon->point_count < 2)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "an icon needs 2 points or more, this one has %d", icon->point_count);
  size_t points = (size_t)icon->point_count + (size_t)icon->spine_count +
                  (size_t)icon->streamline_count;
  size_t points_bytes = points * sizeof icon->points[0], used = 0;
  if (!fg__grow((void **)&icons->entries, &icons->capacity, icons->count + 1,
                sizeof(entry *)))
    return fg__fail_memory(context, "the list of icons",
                           (icons->count + 1) * sizeof(entry *));
  entry *added = fg__allocate(1, sizeof *added + points_bytes);
  if (!added)
    return fg__fail_memory(context, "an icon", sizeof *added + points_bytes);
  added->icon = *icon;
  added->icon.points = add_line(added, &used, icon->points, icon->point_count);
  added->icon.spine = add_line(added, &used, icon->spine, icon->spine_count);
  added->icon.streamline =
      add_line(added, &used, icon->streamline, icon->streamline_count);
  icons->entries[icons->count++] = added;
  return FG_STATUS_OK;
}

fg_status fg__icons_copy(fg_icons **out, fg_context *context, const fg_icons *icons)
{
  fg_status status = fg__icons_create_empty(out, context);
  for (size_t n = 0; n < icons->count && !status; ++n)
    status = fg__icons_add(*out, context, &icons->entries[n]->icon);
  if (!status)
    status = fg__icons_set_projection(*out, context, icons->projection);
  if (status) {
    fg_icons_destroy(*out);
    *out = NULL;
    return status;
  }
  (*out)->clusters = icons->clusters;
  (*out)->dropped = icons->dropped;
  (*out)->next_id = icons->next_id;
  return FG_STATUS_OK;
}

fg_status fg__icons_set_projection(fg_icons *icons, fg_context *context,
                                   const char *projection)
{
  char *copy = fg__copy_text(projection);
  if (projection && !copy)
    return fg__fail_memory(context, "a projection", strlen(projection) + 1);
  free(icons->projection);
  icons->projection = copy;
  return FG_STATUS_OK;
}

const char *fg__icons_plane_of(const fg_field *field)
{
  const fg_field_arrays *arrays = fg_field_contents(field);
  if (arrays->dimension == 2 && arrays->scale == FG_SCALE_GEO)
    return FG__DEGREES;
  return arrays->dimension == 2 ? arrays->projection : NULL;
}

const char *fg_icons_projection(const fg_icons *icons)
{
  return icons ? icons->projection : NULL;
}

void fg__icons_set_clusters(fg_icons *icons, int clusters, int dropped)
{
  icons->clusters = clusters;
  icons->dropped = dropped;
}

void fg_icons_keep_score(fg_icons *icons, const fg_score *score)
{
  icons->has_score = score != NULL;
  if (score)
    icons->score = *score;
}

const fg_score *fg_icons_kept_score(const fg_icons *icons)
{
  return icons && icons->has_score ? &icons->score : NULL;
}

void fg_icons_keep_critical(fg_icons *icons, fg_critical_points *points)
{
  if (points != icons->critical)
    fg_critical_points_destroy(icons->critical);
  icons->critical = points;
}

const fg_critical_points *fg_icons_kept_critical(const fg_icons *icons)
{
  return icons ? icons->critical : NULL;
}

fg_icon *fg__icons_change(fg_icons *icons, int index)
{
  return &icons->entries[index]->icon;
}

void fg__icons_set_next_id(fg_icons *icons, int next_id)
{
  icons->next_id = next_id;
}

int fg__icons_next_id(const fg_icons *icons)
{
  return icons->next_id;
}

int fg_icons_count(const fg_icons *icons)
{
  return (int)icons->count;
}

const fg_icon *fg_icons_at(const fg_icons *icons, int index)
{
  if (index < 0 || (size_t)index >= icons->count)
    return NULL;
  return &icons->entries[index]->icon;
}

int fg_icons_clusters(const fg_icons *icons)
{
  return icons->clusters;
}

int fg_icons_dropped(const fg_icons *icons)
{
  return icons->dropped;
}

#include "icon/icons.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* One block an icon, its points behind it, so that a borrowed fg_icon stays where it is
 * while the list grows. */
typedef struct entry {
  fg_icon icon;
  double points[][3];
} entry;

struct fg_icons {
  entry **entries;
  size_t count, capacity;
  int clusters, dropped;
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
  free(icons);
}

fg_status fg__icons_add(fg_icons *icons, fg_context *context, const fg_icon *icon)
{
  if (icon->point_count < 2)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "an icon needs 2 points or more, this one has %d", icon->point_count);
  size_t points_bytes = (size_t)icon->point_count * sizeof icon->points[0];
  if (!fg__grow((void **)&icons->entries, &icons->capacity, icons->count + 1,
                sizeof(entry *)))
    return fg__fail_memory(context, "the list of icons",
                           (icons->count + 1) * sizeof(entry *));
  entry *added = fg__allocate(1, sizeof *added + points_bytes);
  if (!added)
    return fg__fail_memory(context, "an icon", sizeof *added + points_bytes);
  added->icon = *icon;
  memcpy(added->points, icon->points, points_bytes);
  added->icon.points = (const double(*)[3])added->points;
  icons->entries[icons->count++] = added;
  return FG_STATUS_OK;
}

void fg__icons_set_clusters(fg_icons *icons, int clusters, int dropped)
{
  icons->clusters = clusters;
  icons->dropped = dropped;
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

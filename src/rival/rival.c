/* The methods by name: a new one is a file and a line in the list. */
#include "base/memory.h"
#include "icon/icons.h"
#include "rival/method.h"

#include <stdlib.h>

enum { USUAL_NODES = 257, FEWEST_NODES = 3, MOST_NODES = 16385 };

typedef struct method_entry {
  const char *name;
  fg_status (*draw)(fg_icons *icons, const fg_rival *rival, int count);
} method_entry;

static const method_entry methods[] = {
    [FG_RIVAL_HEDGEHOG] = {"hedgehog", fg__rival_hedgehog},
    [FG_RIVAL_GRID_CURVED] = {"grid-curved", fg__rival_grid_curved},
};

enum { METHODS = sizeof methods / sizeof *methods };

const char *fg_rival_name(fg_rival_method method)
{
  return (int)method >= 0 && (int)method < METHODS ? methods[method].name : NULL;
}

static fg_status settle(fg_rival_options *settled, fg_context *context,
                        const fg_rival_options *options)
{
  if (options)
    *settled = *options;
  if ((int)settled->method < 0 || (int)settled->method >= METHODS)
    return fg__fail(context, FG_STATUS_ARGUMENT, "rival: no method %d",
                    (int)settled->method);
  if (settled->nodes == 0)
    settled->nodes = USUAL_NODES;
  if (settled->nodes < FEWEST_NODES || settled->nodes > MOST_NODES)
    return fg__fail(context, FG_STATUS_ARGUMENT,
                    "rival: a raster of %d nodes, from %d to %d are taken",
                    settled->nodes, FEWEST_NODES, MOST_NODES);
  return FG_STATUS_OK;
}

fg_status fg_rival_create(fg_rival **out, fg_context *context, const fg_field *field,
                          const fg_rival_options *options)
{
  if (!out || !field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "rival: no %s given",
                    out ? "field" : "place for the result");
  *out = NULL;
  if (fg_field_contents(field)->dimension != 2)
    return fg__fail(context, FG_STATUS_UNSUPPORTED,
                    "rival: the field has 3 dimensions, and the methods are made for 2");
  fg_rival *rival = fg__allocate(1, sizeof *rival);
  if (!rival)
    return fg__fail_memory(context, "a rival", sizeof *rival);
  rival->context = context;
  fg_status status = settle(&rival->options, context, options);
  if (status == FG_STATUS_OK)
    status = fg__domain_create(&rival->domain, context, field, rival->options.nodes);
  if (status == FG_STATUS_OK && rival->domain.valid_count == 0)
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "rival: no cell of a raster of %d x %d has a velocity",
                      rival->domain.cells[0], rival->domain.cells[1]);
  if (status != FG_STATUS_OK) {
    fg_rival_destroy(rival);
    return status;
  }
  *out = rival;
  return FG_STATUS_OK;
}

void fg_rival_destroy(fg_rival *rival)
{
  if (!rival)
    return;
  fg__domain_clear(&rival->domain);
  free(rival);
}

fg_status fg_rival_icons(fg_icons **out, fg_rival *rival, int count)
{
  if (!out || !rival)
    return fg__fail(rival ? rival->context : NULL, FG_STATUS_ARGUMENT,
                    "rival: a NULL argument");
  *out = NULL;
  if (count < 1)
    return fg__fail(rival->context, FG_STATUS_ARGUMENT,
                    "rival: %d icons were asked for, at least 1 is needed", count);
  fg_icons *icons = NULL;
  fg_status status = fg__icons_create_empty(&icons, rival->context);
  if (status == FG_STATUS_OK)
    status = methods[rival->options.method].draw(icons, rival, count);
  if (status != FG_STATUS_OK) {
    fg_icons_destroy(icons);
    return status;
  }
  *out = icons;
  return FG_STATUS_OK;
}

/* Which named columns are a length and its direction. */
#include "read/table/table.h"

/* The direction that has this speed; -1: none. */
static int direction_of(const fg__table *table, int speed)
{
  fg__polar ignored;
  const fg__term of_speed = fg__table_term(table, speed);
  for (int c = 0; c < table->columns; ++c) {
    const fg__term terms[2] = {of_speed, fg__table_term(table, c)};
    if (c != speed && fg__speed_of(&ignored, terms, 2, 1) == 0)
      return c;
  }
  return -1;
}

/* Refuses a speed that has a direction beside another column, which is none. */
static fg_status check_half(const fg__table *table, int speed, int other)
{
  const int direction = direction_of(table, speed);
  const char *name = table->column[speed].name;
  if (direction < 0 || direction_of(table, other) >= 0 ||
      fg__names_speed(table->column[other].name))
    return FG_STATUS_OK;
  fg__fail(table->context, FG_STATUS_ARGUMENT,
           "%s: %s is a speed, and %s is no direction", table->path, name,
           table->column[other].name);
  fg__hint(table->context, "name a speed and its direction: --vars %s,%s", name,
           table->column[direction].name);
  return FG_STATUS_ARGUMENT;
}

fg_status fg__table_settle_polar(fg__table_vector *vector, const fg__table *table,
                                 bool on_globe)
{
  int *pair = vector->velocity;
  if (vector->dimension != 2 || !table->named)
    return FG_STATUS_OK;
  const int named[2] = {pair[0], pair[1]};
  const fg__term term[2] = {fg__table_term(table, named[0]),
                            fg__table_term(table, named[1])};
  const int k = fg__direction_among(&vector->polar, &term[0], &term[1]);
  if (k < 0) {
    const fg_status status = check_half(table, named[0], named[1]);
    return status == FG_STATUS_OK ? check_half(table, named[1], named[0]) : status;
  }
  pair[0] = named[1 - k];
  pair[1] = named[k];
  if (on_globe || vector->polar.from_east)
    return FG_STATUS_OK;
  fg__fail(table->context, FG_STATUS_UNSUPPORTED,
           "%s: %s and %s are a length and its direction, which are read with longitude "
           "and latitude only",
           table->path, table->column[pair[0]].name, table->column[pair[1]].name);
  fg__hint(table->context,
           "write components u and v first: whether the direction turns from north or "
           "from x is not known");
  return FG_STATUS_UNSUPPORTED;
}

/* Which dimension is x, y, time and level: by the coordinates' attributes (CF
 * conventions, chapter 4), then by their names, then by their order. */
#include "interpret/interpret.h"
#include "terms/coordinates.h"

#include <string.h>

static fg__role role_of_attributes(const fg__variable *coordinate)
{
  char axis[FG__TEXT_BYTES];
  const fg__term term = fg__term_of(coordinate);
  fg__attribute_text(coordinate, "axis", axis, sizeof axis);
  return fg__role_of_attributes(&term, axis,
                                fg__attribute_find(coordinate, "positive") != NULL);
}

bool fg__may_be_index(const fg__variable *coordinate)
{
  const fg__term term = fg__term_of(coordinate);
  return fg__term_may_be_index(&term);
}

/* The dimension of a file with positions may be another of that name. */
static bool lies_along(const fg__dataset *data, const fg__variable *v, int dimension)
{
  return v->rank == 1 && fg__is_number(v) &&
         (v->dimension[0] == dimension ||
          (v->file >= data->component_files &&
           fg__alike_dimension(data, v->dimension[0], dimension)));
}

/* The coordinate that the names of those along one dimension tell: the one that fits
 * best, of one axis. */
typedef struct called {
  const fg__variable *best; /* NULL: several fit as well */
  fg__role role;            /* NO_ROLE: none, or of several axes, as points have them */
  int fits;
} called;

static void consider_name(called *c, const fg__variable *v, bool named)
{
  int fits;
  const fg__role role = fg__place_of_name(&fits, v->plain_name);
  fits = 8 * named + 2 * fits + (v->geographic != FG__NO_ROLE);
  if (role == FG__NO_ROLE || fits < c->fits)
    return;
  c->best = fits > c->fits ? v : NULL;
  c->role = c->fits == 0 || c->role == role ? role : FG__NO_ROLE;
  c->fits = fits;
}

/* Whether a variable names a coordinate, or xarray lists it for the file; NULL: none
 * does.
 */
static bool is_named(const fg__variable *variable, const fg__variable *coordinate)
{
  char names[FG__TEXT_BYTES];
  if (!variable)
    return false;
  const fg__variable *of[] = {variable, fg__file_of(variable)};
  for (int k = 0; k < 2; ++k)
    if (fg__attribute_text(of[k], "coordinates", names, sizeof names) &&
        fg__is_listed(names, coordinate->plain_name))
      return true;
  return false;
}

/* The coordinate of a dimension: the variable of its name; else one whose attributes say
 * that it is one, which the variable names where it names any; else one with a place's
 * name. */
const fg__variable *fg__coordinate_along(const fg__dataset *data, int dimension,
                                         const fg__variable *variable)
{
  const fg__variable *otherwise = NULL;
  called by_name = {NULL, FG__NO_ROLE, 0};
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (!lies_along(data, v, dimension))
      continue;
    if (strcmp(v->plain_name, data->dimensions[dimension].name) == 0)
      return v;
    if (role_of_attributes(v) != FG__NO_ROLE &&
        (!otherwise || is_named(variable, v) > is_named(variable, otherwise)))
      otherwise = v;
    consider_name(&by_name, v, is_named(variable, v));
  }
  return otherwise || by_name.role == FG__NO_ROLE ? otherwise : by_name.best;
}

const fg__variable *fg__coordinate(const fg__dataset *data, const fg__variable *variable,
                                   int k)
{
  return fg__coordinate_along(data, variable->dimension[k], variable);
}

static bool has_dimension(const fg__variable *v, int dimension)
{
  int k = 0;
  while (k < v->rank && v->dimension[k] != dimension)
    ++k;
  return k < v->rank;
}

/* Whether a variable is one number that lies along no dimension of another. */
static bool is_single(const fg__dataset *data, const fg__variable *v,
                      const fg__variable *variable)
{
  return fg__is_number(v) &&
         (v->rank == 0 ||
          (v->rank == 1 && data->dimensions[v->dimension[0]].length == 1 &&
           !has_dimension(variable, v->dimension[0])));
}

const fg__variable *fg__single_coordinate(const fg__dataset *data,
                                          const fg__variable *variable, fg__role role)
{
  char text[FG__TEXT_BYTES];
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->file != variable->file || !is_single(data, v, variable) ||
        !is_named(variable, v) || role_of_attributes(v) != role)
      continue;
    const bool date = fg__units_of(v, NULL, 0) == FG__QUANTITY_DATE;
    fg__attribute_text(v, "standard_name", text, sizeof text);
    if (role != FG__ROLE_TIME || (date && strcmp(text, "forecast_reference_time") != 0))
      return v;
  }
  return NULL;
}

typedef struct claim {
  fg__role role;
  int strength; /* 2: by attributes; 1: by name */
} claim;

/* Whether a dimension is one of a swath: longitudes lie along it and another of the
 * variable's, and times only beside them. */
static bool is_of_swath(const fg__dataset *data, const fg__variable *variable, int k,
                        const fg__variable *coordinate)
{
  const int dimension = variable->dimension[k];
  if (strcmp(coordinate->plain_name, data->dimensions[dimension].name) == 0)
    return false;
  for (size_t i = 0; i < data->variable_count; ++i) {
    const fg__variable *v = &data->variables[i];
    if (v->rank == 2 && v->geographic == FG__ROLE_X && has_dimension(v, dimension) &&
        has_dimension(variable, v->dimension[0]) &&
        has_dimension(variable, v->dimension[1]))
      return true;
  }
  return false;
}

static claim claim_of(const fg__dataset *data, const fg__variable *variable, int k)
{
  const fg__variable *coordinate = fg__coordinate(data, variable, k);
  claim c = {FG__NO_ROLE, 2};
  if (coordinate)
    c.role = role_of_attributes(coordinate);
  if (c.role == FG__ROLE_TIME && is_of_swath(data, variable, k, coordinate)) {
    coordinate = NULL;
    c.role = FG__NO_ROLE;
  }
  if (c.role != FG__NO_ROLE)
    return c;
  c.strength = 1;
  c.role = fg__role_of_name(data->dimensions[variable->dimension[k]].name);
  if (c.role == FG__NO_ROLE && coordinate)
    c.role = fg__role_of_name(coordinate->plain_name);
  return c;
}

/* A dimension of which one sample is chosen is neither time nor level any more. */
static claim open_claim_of(const fg__dataset *data, const fg__variable *variable, int k)
{
  claim c = claim_of(data, variable, k);
  if (data->dimensions[variable->dimension[k]].is_chosen &&
      (c.role == FG__ROLE_TIME || c.role == FG__ROLE_LEVEL))
    c.role = FG__NO_ROLE;
  return c;
}

fg__role fg__claimed_role(const fg__dataset *data, const fg__variable *variable, int k)
{
  return claim_of(data, variable, k).role;
}

bool fg__is_time(const fg__dataset *data, const fg__variable *variable, int k)
{
  return claim_of(data, variable, k).role == FG__ROLE_TIME;
}

/* Where several dimensions claim a role, x and y go to the last, time and level to the
 * first. */
static void assign_claims(int position[FG__ROLES], const claim *claims, int rank)
{
  for (int role = 0; role < FG__ROLES; ++role) {
    position[role] = -1;
    int strength = 0;
    for (int i = 0; i < rank; ++i) {
      const int k = role <= FG__ROLE_Y ? rank - 1 - i : i;
      if ((int)claims[k].role == role && claims[k].strength > strength) {
        position[role] = k;
        strength = claims[k].strength;
      }
    }
  }
}

static bool is_taken(const int position[FG__ROLES], int k)
{
  for (int role = 0; role < FG__ROLES; ++role)
    if (position[role] == k)
      return true;
  return false;
}

static int last_free(const int position[FG__ROLES], const fg__dataset *data,
                     const fg__variable *v, size_t least)
{
  for (int k = v->rank - 1; k >= 0; --k)
    if (!is_taken(position, k) && data->dimensions[v->dimension[k]].length >= least)
      return k;
  return -1;
}

/* Assigns time and level to remaining dimensions; returns one that can be neither, or
 * -1. */
static int assign_others(int position[FG__ROLES], const fg__dataset *data,
                         const fg__variable *variable)
{
  for (int k = 0; k < variable->rank; ++k) {
    const fg__dimension *d = &data->dimensions[variable->dimension[k]];
    if (is_taken(position, k) || d->is_chosen)
      continue;
    if (position[FG__ROLE_TIME] < 0 && d->unlimited)
      position[FG__ROLE_TIME] = k;
    else if (d->length != 1 && position[FG__ROLE_LEVEL] < 0)
      position[FG__ROLE_LEVEL] = k;
    else if (d->length != 1 && position[FG__ROLE_TIME] < 0)
      position[FG__ROLE_TIME] = k;
    else if (d->length != 1)
      return k;
  }
  return -1;
}

int fg__roles_find(int position[FG__ROLES], const fg__dataset *data,
                   const fg__variable *variable)
{
  claim claims[FG__RANK];
  for (int k = 0; k < variable->rank; ++k)
    claims[k] = open_claim_of(data, variable, k);
  assign_claims(position, claims, variable->rank);
  for (int role = FG__ROLE_X; role <= FG__ROLE_Y; ++role)
    if (position[role] < 0)
      position[role] = last_free(position, data, variable, 2);
  for (int role = FG__ROLE_X; role <= FG__ROLE_Y; ++role)
    if (position[role] < 0)
      position[role] = last_free(position, data, variable, 0);
  return assign_others(position, data, variable);
}

int fg__roles_find_beside(int position[FG__ROLES], const fg__dataset *data,
                          const fg__variable *variable, int along)
{
  claim claims[FG__RANK];
  for (int k = 0; k < variable->rank; ++k) {
    claims[k] = open_claim_of(data, variable, k);
    if (k == along || claims[k].role == FG__ROLE_X || claims[k].role == FG__ROLE_Y)
      claims[k].role = FG__NO_ROLE;
  }
  assign_claims(position, claims, variable->rank);
  position[FG__ROLE_X] = along;
  return assign_others(position, data, variable);
}

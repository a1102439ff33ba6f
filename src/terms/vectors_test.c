/* Which names are a vector's, which is meant of several, and which only look so. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/context_test.h"
#include "terms/vectors.h"

enum { MOST_TERMS = 12, WORD_BYTES = 64 };

/* "name[:standard_name][=units]" parted by blanks; terms point into the text. */
static size_t read_terms(fg__term terms[MOST_TERMS], char *text)
{
  size_t count = 0;
  for (char *word = strtok(text, " "); word && count < MOST_TERMS;
       word = strtok(NULL, " ")) {
    char *units = strchr(word, '='), *standard = strchr(word, '~');
    if (units)
      *units++ = '\0';
    if (standard)
      *standard++ = '\0';
    terms[count++] =
        (fg__term){.name = word, .standard_name = standard, .units = units, .file = -1};
  }
  return count;
}

static void write_vector(char *out, size_t size, const fg__vector *v,
                         const fg__term *terms)
{
  size_t used = strlen(out);
  for (int k = 0; k < 3; ++k)
    if (v->component[k] >= 0)
      used += (size_t)snprintf(out + used, size - used, "%s%s",
                               used && out[used - 1] != ' ' ? "," : "",
                               terms[v->component[k]].name);
  snprintf(out + used, size - used, "%s ",
           v->polar.sense   ? "@"
           : v->is_velocity ? ""
                            : "'");
}

/* The vectors of the best rank, "u,v,w", with ' where they are no velocity. */
static void write_best(char *out, size_t size, const char *names, bool at_points)
{
  char text[512];
  fg__term terms[MOST_TERMS];
  fg__vector *found = NULL;
  size_t count = 0;
  snprintf(text, sizeof text, "%s", names);
  const size_t n = read_terms(terms, text);
  const fg__vector_rules rules = {.at_points = at_points};
  assert_true(fg__vectors_find(&found, &count, terms, n, &rules));
  out[0] = '\0';
  for (size_t i = 0; i < count && found[i].rank == found[0].rank; ++i)
    write_vector(out, size, &found[i], terms);
  if (out[0])
    out[strlen(out) - 1] = '\0';
  free(found);
}

typedef struct names_case {
  const char *names, *wanted;
} names_case;

static void check(const names_case *cases, size_t count, bool at_points)
{
  for (size_t i = 0; i < count; ++i) {
    char found[512];
    write_best(found, sizeof found, cases[i].names, at_points);
    if (strcmp(found, cases[i].wanted) != 0)
      fail_msg("\"%s\" has \"%s\", not \"%s\"", cases[i].names, found, cases[i].wanted);
  }
}

static void of_several_vectors_the_plainest_is_meant(void **state)
{
  static const names_case cases[] = {
      {"u v u_filtered v_filtered", "u,v"},
      {"u_mean v_mean u_rms v_rms", "u_mean,v_mean"},
      {"a_u a_v b_u b_v", "a_u,a_v b_u,b_v"},
      {"vx vy ux uy", "vx,vy"},
      {"u v e n", "u,v"},
      {"u10=m/s v10=m/s u100=m/s v100=m/s", "u10,v10 u100,v100"},
      {"tau_x tau_y u v", "u,v"},
      {"sustr svstr ubar vbar", "ubar,vbar"},
      {"tx=N/m2 ty=N/m2 u=m/s v=m/s", "u,v"},
      {"tx=N/m2 ty=N/m2", "tx,ty'"},
      {"tauu=Pa tauv=Pa", "tauu,tauv'"},
      {"p~eastward_wind q~northward_wind u v", "p,q"},
      {"p~surface_downward_eastward_stress q~surface_downward_northward_stress", "p,q'"},
      {"ws~wind_speed wd~wind_from_direction u v", "u,v"},
      {"ws~wind_speed wd~wind_from_direction t", "ws,wd@"},
      {"wind_speed wind_from_direction", "wind_speed,wind_from_direction@"},
      {"a_speed current_speed current_to_direction",
       "current_speed,current_to_direction@"},
      {"ws~wind_speed wind_from_direction", "ws,wind_from_direction@"},
      {"wspd10 wdir10 wspd wdir", "wspd10,wdir10@ wspd,wdir@"},
      {"U V u v", "U,V u,v"},
      {"U:0 U:1 U:2 V:0 V:1 V:2", "U:0,U:1,U:2 V:0,V:1,V:2"},
      {"u_0 v_0 u_1 v_1", "u_0,v_0 u_1,v_1"},
      {"u u_sigma v v_sigma", "u,v"},
      {"u_sigma v_sigma", "u_sigma,v_sigma"},
      {"e n u", "e,n,u"},
      {"e n u v", "u,v"},
      {"vel_x vel_z p", "vel_x,vel_z'"},
      {"w u", "u,w'"},
  };
  (void)state;
  check(cases, sizeof cases / sizeof *cases, false);
}

static void third_components_fit_the_others(void **state)
{
  static const names_case cases[] = {
      {"u v w", "u,v,w"},
      {"velX velY velZ", "velX,velY,velZ"},
      {"east north up", "east,north,up"},
      {"u=m/s v=m/s w=Pa/s", "u,v"},
      {"U:0 U:1 U:2", "U:0,U:1,U:2"},
      {"Velocity[i] Velocity[j] Velocity[k]", "Velocity[i],Velocity[j],Velocity[k]"},
      {"uwnd vwnd wwnd", "uwnd,vwnd,wwnd"},
      {"a~eastward_wind b~northward_wind c~upward_air_velocity", "a,b,c"},
      {"a~eastward_wind b~northward_wind c~upward_air_velocity d~upward_air_velocity",
       "a,b"},
      {"vozocrtx vomecrty vovecrtz", "vozocrtx,vomecrty,vovecrtz"},
      {"B_x B_y B_z", "B_x,B_y,B_z"},
      {"u v z", "u,v"},
  };
  (void)state;
  check(cases, sizeof cases / sizeof *cases, false);
}

/* On a grid lengths are sizes of cells and places; of points they may be displacements.
 */
static void lengths_may_be_displacements(void **state)
{
  static const names_case cases[] = {{"dx=mm dy=mm", "dx,dy'"}, {"u=mm v=mm", "u,v'"}};
  static const names_case none[] = {
      {"dx=mm dy=mm", ""},
      {"p~sea_ice_x_displacement=km q~sea_ice_y_displacement=km", "p,q'"}};
  (void)state;
  check(cases, sizeof cases / sizeof *cases, true);
  check(none, sizeof none / sizeof *none, false);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(of_several_vectors_the_plainest_is_meant),
      cmocka_unit_test(third_components_fit_the_others),
      cmocka_unit_test(lengths_may_be_displacements),
  };
  return cmocka_run_group_tests_name("terms/vectors", tests, NULL, NULL);
}

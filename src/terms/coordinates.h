/* What a dimension, coordinate or column is for, by its names and attributes. */
#ifndef FG__TERMS_COORDINATES_H
#define FG__TERMS_COORDINATES_H

#include "terms/term.h"

/* Longitude (X), latitude (Y), ...: what a dimension or a coordinate is for. */
typedef enum fg__role {
  FG__NO_ROLE = -1,
  FG__ROLE_X = 0,
  FG__ROLE_Y,
  FG__ROLE_TIME,
  FG__ROLE_LEVEL
} fg__role;

enum { FG__ROLES = 4 };

/* The role of a coordinate by its attributes (CF conventions, chapter 4): `axis`, its
 * standard name, units, and `positive`, which only levels have. */
fg__role fg__role_of_attributes(const fg__term *term, const char *axis,
                                bool has_positive);

/* The role of a dimension or coordinate by its name alone. Only unambiguous names: in
 * files converted from GRIB "gridx" is an index. */
fg__role fg__role_of_name(const char *name);

/* X for a longitude, Y for a latitude, by units, standard name and name; else none. */
fg__role fg__geographic_role(const fg__term *term);

/* Whether a coordinate may be a mere index: it has neither units nor a standard name. */
bool fg__term_may_be_index(const fg__term *term);

/* What a column or array beside those of a vector has. */
typedef enum fg__column_use {
  FG__COLUMN_X = 0, /* of a plane or space */
  FG__COLUMN_Y,
  FG__COLUMN_Z,
  FG__COLUMN_LONGITUDE,
  FG__COLUMN_LATITUDE,
  FG__COLUMN_LEVEL, /* of planes one above another */
  FG__COLUMN_TIME,
  FG__COLUMN_VALIDITY /* says whether a row counts */
} fg__column_use;

/* Whether a name is one of those that columns of that use have: 2; or may be, if no other
 * is ("px", "x_mm", "x_rho", "nav_lon_u"): 1; else 0. */
int fg__column_fits(const char *name, fg__column_use use);

/* The axis along which a name places samples, and how well it fits a column of that; X
 * and Y may be those of the globe. */
fg__role fg__place_of_name(int *fits, const char *name);

/* Whether a name is that of a coordinate, which is no component of a vector, such as "x",
 * "xc", "x_rho", "x_0", "lon_u". */
bool fg__names_coordinate(const char *name);

#endif

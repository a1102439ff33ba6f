/* Which variables are a vector, which vector goes first, and what it is called. */
#include "read/netcdf/situation_test.h"

#define PLANE "lat[2] :units=degrees_north = 1 2; lon[3] :units=degrees_east = 1 2 3;"
#define OF(name, attributes) "float " name "(lat,lon)" attributes " = 1 2 3 4 5 7;"
#define SPEED " :units=m/s"
#define NAMED(name) SPEED " :standard_name=" name
#define EASTWARD NAMED("eastward_wind")
#define NORTHWARD NAMED("northward_wind")
#define WINDS(height) OF("u" height, EASTWARD) OF("v" height, NORTHWARD)
#define U_V OF("u", SPEED) OF("v", SPEED)

/* a pair of standard names, the second first */
#define STANDARD(first, second)                                                          \
  {                                                                                      \
    .what = first, .file = PLANE OF("beta", NAMED(second)) OF("alpha", NAMED(first)),    \
    .inventory = "vectors 1|[alpha,beta "                                                \
  }
#define FIRST(name, variables)                                                           \
  {                                                                                      \
    .what = "evidence: " name " goes first", .file = PLANE variables,                    \
    .field = "name '" name "'\nx ="                                                      \
  }
/* what a pair is called, from what its components' attributes share */
#define TITLE(attribute, first, second, title)                                           \
  {                                                                                      \
    .what = title,                                                                       \
    .file = PLANE OF("u", " :" attribute "=" first)                                      \
        OF("v", " :" attribute "=" second) ":title=the file",                            \
    .field = "title '" title "'"                                                         \
  }

static const situation SITUATIONS[] = {
    {.what = "what only resembles a vector",
     .file = PLANE OF("u_err", " :units=1") OF("v_err", " :units=1") OF("uerr", SPEED)
         OF("verr", SPEED) OF("ulon", " :units=degrees_east")
             OF("vlon", " :units=degrees_east") OF("x", " :units=m") OF("y", " :units=m")
                 OF("dx", " :units=m") OF("dy", " :units=m")
                     OF("pm", " :units=meter-1 :standard_name=inverse_of_cell_x_size") OF(
                         "pn", " :units=meter-1 :standard_name=inverse_of_cell_y_size")
                         OF("a", " :units=m :standard_name=projection_x_coordinate")
                             OF("b", " :units=m :standard_name=projection_y_coordinate")
                                 OF("q1", " :standard_name=eastward_wind status_flag")
                                     OF("q2", " :standard_name=northward_wind "
                                              "status_flag") OF("u2", "") OF("w2", ""),
     .inventory = "vectors 0"},
    STANDARD("eastward_wind", "northward_wind"),
    STANDARD("x_wind", "y_wind"),
    STANDARD("grid_eastward_wind", "grid_northward_wind"),
    STANDARD("eastward_sea_water_velocity", "northward_sea_water_velocity"),
    STANDARD("sea_water_x_velocity", "sea_water_y_velocity"),
    STANDARD("sea_water_x_velocity_at_u_location", "sea_water_y_velocity_at_v_location"),
    STANDARD("surface_eastward_sea_water_velocity",
             "surface_northward_sea_water_velocity"),
    STANDARD("barotropic_eastward_sea_water_velocity",
             "barotropic_northward_sea_water_velocity"),
    STANDARD("surface_geostrophic_eastward_sea_water_velocity",
             "surface_geostrophic_northward_sea_water_velocity"),
    STANDARD("sea_surface_wave_stokes_drift_x_velocity",
             "sea_surface_wave_stokes_drift_y_velocity"),
    STANDARD("eastward_sea_ice_velocity", "northward_sea_ice_velocity"),
    STANDARD("sea_ice_x_velocity", "sea_ice_y_velocity"),
    STANDARD("surface_downward_eastward_stress", "surface_downward_northward_stress"),
    {.what = "lengths, which otherwise are places",
     .file = PLANE OF("dX", " :units=km :standard_name=sea_ice_x_displacement")
         OF("dY", " :units=km :standard_name=sea_ice_y_displacement"),
     .inventory = "vectors 1|[dX,dY "},
    {.what = "heights of one standard name are told apart",
     .file = PLANE WINDS("10") WINDS("100"),
     .inventory = "vectors 2|[u10,v10 |[u100,v100 ",
     .status = FG_STATUS_ARGUMENT,
     .refused = "u10,v10; u100,v100",
     .hint = "--vars"},
    {.what = "one of them",
     .options = {.vars = "u100,v100"},
     .field = "name 'u100'|name 'v100'"},
    {.what = "one of them in the wrong order",
     .options = {.vars = "v100,u100"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "'v100' is the second component",
     .hint = "--vars u100,v100"},
    FIRST("p", U_V OF("p", EASTWARD) OF("q", NORTHWARD)),
    FIRST("u",
          OF("p", " :units=Pa :standard_name=surface_downward_eastward_stress")
              OF("q", " :units=Pa :standard_name=surface_downward_northward_stress") U_V),
    FIRST("u", OF("tx", " :units=N m-2") OF("ty", " :units=N m-2") U_V),
    /* Arakawa's C grid is listed with the reason, and no other kind of vector is read */
    {.what = "a staggered pair without coordinates of centres",
     .file = "y[3] :units=m = 1 2 3; yv[2] :units=m = 1 2; x[4] :units=m = 1 2 3 4; "
             "xu[3] :units=m = 1 2 3; float u(y,xu); float v(yv,x); float taux(y,x) "
             ":units=Pa m; float tauy(y,x) :units=Pa m",
     .inventory = "vectors 2\n[u,v |unusable |'u' is 3 x 3, 'v' is 2 x 4|[taux,tauy ",
     .refused = "staggered"},
    {.what = "the other of its file",
     .options = {.vars = "taux,tauy"},
     .inventory = "vectors 1\n[taux,tauy |!unusable"},
    {.what = "equal sizes at different places",
     .file = "y[3] :units=m = 1 2 3; x[3] :units=m = 1 2 3; xu[3] :units=m = 1.5 2.5 "
             "3.5; float u(y,xu); float v(y,x)",
     .refused = "'xu'"},

    /* as NEMO, MPAS-Ocean, FVCOM, WRF, POP, ROMS and altimetry's products write them */
    TITLE("long_name", "Ocean current along i-axis", "Ocean current along j-axis",
          "Ocean current"),
    TITLE("long_name", "component of horizontal velocity in the eastward direction",
          "component of horizontal velocity in the northward direction",
          "horizontal velocity"),
    TITLE("long_name", "Vertically Averaged x-velocity", "Vertically Averaged y-velocity",
          "Vertically Averaged velocity"),
    TITLE("description", "x-wind component", "y-wind component", "wind"),
    TITLE("description", "U at 10 M", "V at 10 M", "the file"),
    TITLE("long_name", "Velocity in grid-x direction", "Velocity in grid-y direction",
          "Velocity"),
    TITLE("long_name", "u-momentum component", "v-momentum component", "the file"),
    TITLE("long_name", "vertically integrated u-momentum component",
          "vertically integrated v-momentum component", "vertically integrated momentum"),
    TITLE("long_name", "Absolute geostrophic velocity: zonal component",
          "Absolute geostrophic velocity: meridian component",
          "Absolute geostrophic velocity"),
    TITLE("standard_name", "grid_eastward_wind", "grid_northward_wind", "wind"),
    TITLE("long_name", "Wind speed to the east", "Wind speed to the north", "Wind speed"),
    /* numbers for dates differ in their last digits; the unit "level" (CESM) says
       nothing */
    {.what = "numbers of times and levels",
     .file = "time[1] :units=yyyymmdd = 19900101; lev[1] :units=level = 992.5;" PLANE
             "float u(time,lev,lat,lon) = 1 2 3 4; float v(time,lev,lat,lon) = 1 2 3 4",
     .field = "time '1990-01-01'|level 'lev 992.5'"},
};

SITUATIONS_MAIN("read/netcdf/pairs", SITUATIONS)

/* Staggered components in a plane, and walls between them. */
#include "read/netcdf/situation_test.h"

/* Centres of 7 columns and 5 rows; the components are linear, so that the mean of two
 * faces is exact. `left` and `top` are the places of the first faces. */
#define SPEED " :units=m s-1 ~ "
#define LINE(name, first, step) name " :units=m ~ " first " " step ";"
#define LINES(u, v, x, y, columns, rows, left, top)                                      \
  LINE(u "[" columns "]", left, u " 200")                                                \
  LINE(v "[" rows "]", top, v " -500")                                                   \
  LINE(x "[7]", "1000", x " 200")                                                        \
  LINE(y "[5]", "9000", y " -500")                                                       \
  "u(" y "," u ")" SPEED "0 @" u " 2e-4 @" y " 1e-4; v(" v "," x ")" SPEED "0 @" v       \
  " 3e-4 @" x " -1e-4;"
#define STAGGERED(what_, size, file_)                                                    \
  {                                                                                      \
    .what = what_, .file = file_,                                                        \
    .field = "map " size "\n|linear 0 2e-4 1e-4 0 -1e-4 3e-4 within 1e-5|missing 0\n",   \
    .inventory = "frame 'along the axes (a staggered grid)'"                             \
  }

static const situation SITUATIONS[] = {
    STAGGERED("a face on either side", "7 x 5",
              LINES("Xp1", "Yp1", "X", "Y", "8", "6", "900", "9250")),
    STAGGERED("faces before their centres", "6 x 4",
              LINES("XG", "YG", "XC", "YC", "7", "5", "900", "9250")),
    STAGGERED("faces behind their centres", "6 x 4",
              LINES("xq", "yq", "xh", "yh", "7", "5", "1100", "8750")),
    STAGGERED("faces between centres, whose places are in a plane (ROMS)", "5 x 3",
              "xi_rho[7]; eta_rho[5]; xi_u[6]; eta_v[4]; x_rho(eta_rho,xi_rho) :units=m "
              "~ 1000 xi_rho 200; y_rho(eta_rho,xi_rho) :units=m ~ 9000 eta_rho -500; "
              "u(eta_rho,xi_u)" SPEED "1.12 xi_u .04 eta_rho -.05; v(eta_v,xi_rho)" SPEED
              "2.525 eta_v -.15 xi_rho -.02;"),
    /* A missing face beside a present one is a wall; a centre is missing where all faces
     * of either component are. */
    {.what = "walls are zero",
     .file = "y[2] :units=m = 0 1; xf[5] :units=m = -.5 .5 1.5 2.5 3.5; yf[3] :units=m = "
             "-.5 .5 1.5; x[4] :units=m = 0 1 2 3; u(y,xf) = _ _ 4 6 _ _*5; v(yf,x) = _ "
             "1 2 _ _ 3 4 _ _ _ 2 _",
     .field = "u = nan 2 5 3 nan 0 0 nan\n|v = nan 2 3 0 nan 1.5 3 nan\n"},
};

SITUATIONS_MAIN("read/netcdf/faces", SITUATIONS)

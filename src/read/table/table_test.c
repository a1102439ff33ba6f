/* Tables: what is found in them, and where they are refused. */
#include "read/situation_test.h"

/* A grid of 3 x 2: x 1.5 2.5 3.5, y 10 20; u = x + y, v = -0.25. */
#define VALUES(u)                                                                        \
  " 3 x 2\n|x = 1.5 2.5 3.5\n|y = 10 20\n|u = " u " 12.5 13.5 21.5 22.5 23.5\n"
#define SMALL VALUES("11.5") "|v = -0.25 -0.25 -0.25 -0.25 -0.25 -0.25\n"
/* its first sample is missing */
#define WITH_GAP VALUES("nan") "|v = nan -0.25 -0.25 -0.25 -0.25 -0.25\n"
#define UPRIGHT(first, second, across)                                                   \
  " 3 x 2\n|axis 0 '" first "'|axis 1 '" second                                          \
  "'|u = 11.5 12.5 13.5 21.5 22.5 23.5\n|v = -0.25 -0.25 -0.25 "                         \
  "-0.25 -0.25 -0.25\n|x = 1.5 2.5 3.5\n|y = 10 20\n|level '" across "'"
#define WITH_NAMES(head)                                                                 \
  {                                                                                      \
    .what = head,                                                                        \
    .text =                                                                              \
        head "\n1.5,10,11.5,-0.25,1,1\n2.5,10,12.5,-0.25,2,1\n3.5,10,13.5,-0.25,3,1\n1." \
             "5,20,21.5,-0.25,1,2\n2.5,20,22.5,-0.25,2,2\n3.5,20,23.5,-0.25,3,2\n",      \
    .field = SMALL                                                                       \
  }
#define MISSING(word)                                                                    \
  {                                                                                      \
    .what = word,                                                                        \
    .text = "x,y,u,v\n1.5,10," word "," word                                             \
            "\n2.5,10,12.5,-0.25\n3.5,10,13.5,-0.25\n1.5,20,21.5,-0.25\n2.5,20,22.5,-0." \
            "25\n3.5,20,23.5,-0.25\n",                                                   \
    .field = WITH_GAP                                                                    \
  }
#define VOLUME                                                                           \
  " 3 x 2 x 2\n|x = 0 1 2.5\n|y = -1 0.5\n|z = 3 10\n|u = 0 1 2 3 4 5 6 7 8 9 10 "       \
  "11\n|v = 0 0.5 1 1.5 2 2.5 3 3.5 4 4.5 5 5.5\n|w = 0 -1 -2 -3 -4 -5 -6 -7 -8 -9 -10 " \
  "-11\n"
/* points at one of the coordinates round the globe */
#define CIRCLE(before, after)                                                            \
  before "0" after before "30" after before "60" after before "90" after before          \
         "120" after before "150" after before "180" after before "210" after before     \
         "240" after before "270" after before "300" after before "330" after
#define GLOBE CIRCLE("", ",-1,2,30\n") CIRCLE("", ",0,2,30\n") CIRCLE("", ",1,2,30\n")
#define OTHER_GLOBE                                                                      \
  CIRCLE("-30,", ",2,30\n") CIRCLE("0,", ",2,30\n") CIRCLE("30,", ",2,30\n")
#define CLOSED "geo 12 x 3\n|period 0 360|"
#define REFUSED(text_, status_, words)                                                   \
  {                                                                                      \
    .what = words, .text = text_, .status = status_, .refused = words                    \
  }
#define MALFORMED(text_, words) REFUSED(text_, FG_STATUS_FILE_FORMAT, words)
#define CHOICES                                                                          \
  "a,b,wind_u,wind_v,wave_u,wave_v,ice\n1,1,1,2,5,6,1\n2,1,1,2,5,6,1\n1,2,1,2,5,6,0\n2," \
  "2,1,2,5,6,1\n"

static const situation SITUATIONS[] = {
    {.what = "commas, rows in any order",
     .text = "x,y,u,v\n3.5,20,23.5,-.25\n1.5,10,11.5,-0.25\n2.5,10,12.5,-25e-2\n"
             "3.5,10,13.5,-0.25\n1.5,20,21.5,-0.25\n2.5,20,22.5,-0.25\n",
     .field = SMALL},
    {.what = "semicolons and decimal commas, a mark of UTF-8, ends of lines as in DOS",
     .text = "\xEF\xBB\xBFX (mm);Y (mm);Vx (m/s);Vy (m/s)\r\n1,5;10;11,5;-0,25\r\n"
             "2,5;10;12,5;-0,25\r\n3,5;10;13,5;-0,25\r\n1,5;20;21,5;-0,25\r\n"
             "2,5;20;22,5;-0,25\r\n3,5;20;23,5;-0,25\r\n",
     .field = SMALL},
    {.what =
         "blanks, comments, a name with a unit, more columns, no end of the last line",
     .text =
         "# made by hand\n#  x [mm]  y [mm]  p [Pa]  u [m/s] v [m/s]\n"
         "1.5 10.0 7 1.15E+01 -2.5e-1\n2.5 10.0 7 12.5 -0.25\n\n3.5 10.0 nan 13.5 -0.25\n"
         "% half\n  1.5 20.0 7 2.15D1 -0.25\n2.5 20.0 7 22.5 -0.25\n3.5 20 7 23.5 -0.25",
     .field = SMALL},
    {.what = "longitudes that count to the west by their name, or by a unit",
     .text = "longitude_W,Latitude (deg N),u,v\n10,10,11.5,-.25\n9,10,12.5,-.25\n"
             "8,10,13.5,-.25\n10,20,21.5,-.25\n9,20,22.5,-.25\n8,20,23.5,-.25\n",
     .field = "geo 3 x 2|x = -10 -9 -8|u = 11.5 12.5 13.5 21.5"},
    {.what = "the same, and a sign",
     .text = "longitude_W,latitude,u,v\n-10,10,11.5,-.25\n-9,10,12.5,-.25\n"
             "-10,20,13.5,-.25\n-9,20,21.5,-.25\n",
     .status = FG_STATUS_FILE_FORMAT,
     .refused = "'longitude_W' is in degrees_west by its name, and has -10"},
    {.what = "a plane along x and z, and components along y and z",
     .text = "x,z,v,w\n0,0,1,1\n1,0,1,2\n0,1,1,3\n1,1,1,4\n",
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "no vectors found among its 4 variables"},
    {.what = "places in two units",
     .text = "x [mm],y [m],u,v\n1,10,11.5,-.25\n2,10,12.5,-.25\n1,20,13.5,-.25\n"
             "2,20,21.5,-.25\n",
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "'x' is in mm, 'y' in m: no plane"},
    {.what = "a speed and its direction with their units",
     .text = "lon,lat,wind_speed_kt,wind_dir_deg\n1,10,2,270\n2,10,3,270\n1,20,4,270\n"
             "2,20,5,270\n",
     .field = "geo 2 x 2|units 'kn'|u = 2 3 4 5"},
    {.what = "tabs, quotes, text among the numbers, decimal commas",
     .text =
         "\"name\"\t\"u\"\t\"v\"\t\"x\"\t\"y\"\n\"a \"\"b\"\"\"\t11,5\t-0,25\t1,5\t10\n"
         "b\t12,5\t-0,25\t2,5\t10\nc\t13,5\t-0,25\t3,5\t10\nd\t21,5\t-0,25\t1,5\t20\n"
         "e\t22,5\t-0,25\t2,5\t20\n\"f\"\t23,5\t-0,25\t3,5\t20\n",
     .field = SMALL},
    {.what = "no names: x, y, u, v; blanks round decimal commas",
     .text = "1,5  10  11,5 -0,25\n2,5  10  12,5 -0,25\n3,5  10  13,5 -0,25\n"
             "1,5  20  21,5 -0,25\n2,5  20  22,5 -0,25\n3,5  20  23,5 -0,25\n",
     .field = SMALL},
    {.what = "names, then units",
     .text =
         "x,y,u,v\nmm,mm,m/s,m/s\n1.5,10,11.5,-0.25\n2.5,10,12.5,-0.25\n"
         "3.5,10,13.5,-0.25\n1.5,20,21.5,-0.25\n2.5,20,22.5,-0.25\n3.5,20,23.5,-0.25\n",
     .field = SMALL},
    {.what = "names that do not fit the columns are not left out",
     .text = "# u,v,x,y\n1 2 10 20\n1 2 11 20\n1 2 10 21\n1 2 11 21\n",
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "no vectors found among its 4 variables: 1, 2, 3, 4"},
    {.what = "the same, and numbers of columns",
     .options = {.vars = "3,4,1,2"},
     .field = " 2 x 2\n|x = 10 11\n|y = 20 21\n|u = 1 1 1 1\n"},
    {.what = "names far above the data",
     .text = "# lat lon u v\n#\n# a\n# b\n# c\n# d\n# e\n# f\n# g\n# h\n# i\n"
             "20 10 1 2\n20 11 1 2\n21 10 1 2\n21 11 1 2\n",
     .status = FG_STATUS_UNSUPPORTED,
     .refused = "no vectors found among its 4 variables: 1, 2, 3, 4"},
    {.what = "a radar's table in LLUV, whose header names types of columns",
     .text = "%TableType: LLUV TOT4\n%TableColumns: 6\n"
             "%TableColumnTypes: LOND LATD VELU VELV VFLG UQAL\n%TableStart:\n"
             "%%  Longitude  Latitude  U comp  V comp  VectorFlag  U StdDev\n"
             "%%  (deg)  (deg)  (cm/s)  (cm/s)  (GridCode)  Quality\n"
             "1.5 10 11.5 -.25 0 1\n2.5 10 12.5 -.25 0 1\n3.5 10 13.5 -.25 0 1\n"
             "1.5 20 21.5 -.25 0 1\n2.5 20 22.5 -.25 0 1\n3.5 20 23.5 -.25 0 1\n"
             "%TableEnd:\n",
     .field = "geo" SMALL "|name 'VELU'|units 'cm/s'"},
    {.what = "a coordinate of space that is the same everywhere",
     .text = "Points:0,Points:1,Points:2,U:0,U:1,U:2\n1.5,10,3,11.5,-0.25,9\n"
             "2.5,10,3,12.5,-0.25,9\n3.5,10,3,13.5,-0.25,9\n1.5,20,3,21.5,-0.25,9\n"
             "2.5,20,3,22.5,-0.25,9\n3.5,20,3,23.5,-0.25,9\n",
     .field = SMALL},
    {.what = "a volume",
     .text =
         "X,Y,Z,U,V,W\n0,-1,3,0,0,0\n1,-1,10,7,3.5,-7\n2.5,-1,3,2,1,-2\n0,0.5,10,9,4.5,-"
         "9\n1,0.5,3,4,2,-4\n2.5,0.5,10,11,5.5,-11\n0,-1,10,6,3,-6\n1,-1,3,1,0.5,-1\n2.5,"
         "-1,10,8,4,-8\n0,0.5,3,3,1.5,-3\n1,0.5,10,10,5,-10\n2.5,0.5,3,5,2.5,-5\n",
     .field = VOLUME},
    {.what = "a volume without names",
     .text = "0 -1 3 0 0 0\n1 -1 10 7 3.5 -7\n2.5 -1 3 2 1 -2\n0 0.5 10 9 4.5 -9\n1 0.5 "
             "3 4 2 -4\n2.5 0.5 10 11 5.5 -11\n0 -1 10 6 3 -6\n1 -1 3 1 0.5 -1\n2.5 -1 "
             "10 8 4 -8\n0 0.5 3 3 1.5 -3\n1 0.5 10 10 5 -10\n2.5 0.5 3 5 2.5 -5\n",
     .field = VOLUME},
    {.what = "constant y",
     .text = "x,y,z,u,v,w\n1.5,7,10,11.5,99,-.25\n2.5,7,10,12.5,99,-.25\n"
             "3.5,7,10,13.5,99,-.25\n1.5,7,20,21.5,99,-.25\n2.5,7,20,22.5,99,-.25\n"
             "3.5,7,20,23.5,99,-.25\n",
     .field = UPRIGHT("x", "z", "y = 7") "|name 'u'|name 'w'"},
    {.what = "constant x",
     .text = "x y z u v w\n-3 1.5 10 99 11.5 -.25\n-3 2.5 10 99 12.5 -.25\n"
             "-3 3.5 10 99 13.5 -.25\n-3 1.5 20 99 21.5 -.25\n-3 2.5 20 99 22.5 -.25\n"
             "-3 3.5 20 99 23.5 -.25\n",
     .field = UPRIGHT("y", "z", "x = -3") "|name 'v'|name 'w'"},
    {.what = "no y",
     .text = "w,u,z,x\n-.25,11.5,10,1.5\n-.25,12.5,10,2.5\n-.25,13.5,10,3.5\n"
             "-.25,21.5,20,1.5\n-.25,22.5,20,2.5\n-.25,23.5,20,3.5\n",
     .field = UPRIGHT("x", "z", "") "|name 'u'|name 'w'"},
    /* it rises by 3 over 4 along x; what points out of the plane is left out */
    {.what = "a tilted plane has its own axes",
     .text =
         "x,y,z,u,v,w\n0,0,1,-0.4,0,2.2\n4,0,4,0.4,0,2.8\n8,0,7,1.2,0,3.4\n12,0,10,2,0,"
         "4\n0,1,1,2.8,-1,4.6\n4,1,4,3.6,-1,5.2\n8,1,7,4.4,-1,5.8\n12,1,10,5.2,-1,6.4\n0,"
         "2,1,6,-2,7\n4,2,4,6.8,-2,7.6\n8,2,7,7.6,-2,8.2\n12,2,10,8.4,-2,8.8\n",
     .field = " 4 x 3\n|axis 0 'x''|axis 1 'y'|u = 1 2 3 4 5 6 7 8 9 10 11 12\n|v = 0 0 "
              "0 0 -1 -1 -1 -1 -2 -2 -2 -2\n|y = 0 1 2\n|x = 0.6 5.6 10.6 15.6\n"},
    {.what = "Insight",
     .text = "TITLE=\"E:\\Run1\" VARIABLES=\"X mm\", \"Y mm\", \"U m/s\", \"V m/s\", "
             "\"CHC\", "
             "DATASETAUXDATA Application=\"PIV\" ZONE I=3, J=2, F=POINT\n"
             "1.5, 20.0, 21.5, -0.25, 1\n2.5, 20.0, 22.5, -0.25, 2\n3.5, 20.0, 23.5, "
             "-0.25, 1\n"
             "2.5, 10.0, 12.5, -0.25, 1\n1.5, 10.0, 0.0, -0.0, -3\n3.5, 10.0, 13.5, "
             "-0.25, 1\n",
     .field = WITH_GAP "|units 'm/s'|' 'mm'\nname '"},
    {.what = "DaVis",
     .text =
         "#DaVis 8.1.2 2D-vector 8 2 3 \"position\" \"mm\" \"position\" \"mm\" "
         "\"velocity\" "
         "\"m/"
         "s\"\r\n1,5\t20\t21,5\t-0,25\r\n2,5\t20\t22,5\t-0,25\r\n3,5\t20\t23,5\t-0,25\r\n"
         "2,5\t10\t12,5\t-0,25\r\n1,5\t10\t0\t-0\r\n3,5\t10\t13,5\t-0,25\r\n",
     .field = WITH_GAP "|units 'm/s'|' 'mm'\nname '"},
    {.what = "OpenPIV, without units",
     .text =
         "# "
         "x\ty\tu\tv\tflags\tmask\n1.5\t20\t21.5\t-0.25\t0\t0\n2.5\t20\t22.5\t-0."
         "25\t0\t0\n"
         "3.5\t20\t23.5\t-0.25\t0\t0\n2.5\t10\t12.5\t-0.25\t0\t0\n1.5\t10\t5\t5\t1\t0\n"
         "3.5\t10\t13.5\t-0.25\t0\t0\n",
     .field = WITH_GAP "|units ''|' ''\nname '"},
    {.what = "PIVlab",
     .text =
         "PIVlab, ASCII chart output - 01-Jan-2020\nFRAME: 1, filenames: A.jpg & B.jpg, "
         "conversion factor xy (px -> m): 1, conversion factor uv (px/frame -> m/s): 1\n"
         "x [mm],y [mm],u [m/s],v [m/s],Vector type [-]\n1.5,20,21.5,-0.25,1\n"
         "2.5,20,22.5,-0.25,2\n3.5,20,23.5,-0.25,1\n2.5,10,12.5,-0.25,1\n1.5,10,NaN,NaN,"
         "0\n"
         "3.5,10,13.5,-0.25,1\n",
     .field = WITH_GAP "|units 'm/s'|' 'mm'\nname '"},
    {.what = "Tecplot",
     .text =
         "TITLE = \"a table\"\nVARIABLES = \"x (mm)\"\n\"y (mm)\"\n\"u (m/s)\"\n\"v "
         "(m/s)\"\n"
         "\"isValid\"\nZONE T=\"one\", I=3, J=2,\n DATAPACKING=POINT\n1.5 20 21.5 -0.25 "
         "1\n"
         "2.5 20 22.5 -0.25 1\n3.5 20 23.5 -0.25 1\n2.5 10 12.5 -0.25 1\n1.5 10 1 1 0\n"
         "3.5 10 13.5 -0.25 1\n",
     .field = WITH_GAP "|units 'm/s'|' 'mm'\nname '"},
    {.what = "STAR-CCM+",
     .text = "\"Velocity[i] (m/s)\",\"Velocity[j] (m/s)\",\"Velocity[k] (m/s)\",\"X "
             "(m)\",\"Y "
             "(m)\",\"Z (m)\"\n11.5,-0.25,0,1.5,10,0\n12.5,-0.25,0,2.5,10,0\n"
             "13.5,-0.25,0,3.5,10,0\n21.5,-0.25,0,1.5,20,0\n22.5,-0.25,0,2.5,20,0\n"
             "23.5,-0.25,0,3.5,20,0\n",
     .field = SMALL "|units 'm/s'|' 'm'\nname '"},
    {.what = "CFD-Post, with the faces of a surface",
     .text =
         "\n[Name]\nPlane 1\n\n[Data]\nX [ m ], Y [ m ], Z [ m ], Velocity u [ m/s ], "
         "Velocity v [ m/s ], Velocity w [ m/s ]\n1.5, 10, 0, 11.5, -0.25, 0\n"
         "2.5, 10, 0, 12.5, -0.25, 0\n3.5, 10, 0, 13.5, -0.25, 0\n"
         "1.5, 20, 0, 21.5, -0.25, 0\n2.5, 20, 0, 22.5, -0.25, 0\n"
         "3.5, 20, 0, 23.5, -0.25, 0\n\n[Faces]\n0, 1, 4, 3\n1, 2, 5, 4\n",
     .field = SMALL "|units 'm/s'|' 'm'\nname '"},
    WITH_NAMES("x_mm,y_mm,u_ms,v_ms,p,q"),
    WITH_NAMES("xpos,ypos,xvel,yvel,p,q"),
    WITH_NAMES("x_px,y_px,vel_x,vel_y,i,j"),
    MISSING("#N/A"),
    MISSING("-nan(ind)"),
    MISSING("-1.#IND"),
    MISSING("1.#QNAN"),
    {.what = "where wind comes from",
     .text = "lon,lat,wind_speed (m/s),wind_direction\n" GLOBE,
     .field = CLOSED "u = -1 -1 -1 -1 -1 -1 |v = -1.73205 -1.73205 |units 'm/s'"},
    {.what = "where a current goes to",
     .text = "Latitude,Longitude,current speed,current dir\n" OTHER_GLOBE,
     .field = CLOSED "u = 1 1 1 1 1 1 |v = 1.73205 1.73205 |units ''"},
    {.what = "nothing was measured at the place of a measurement",
     .text = "lon,lat,sknt,drct\n" GLOBE "0,0,M,M\n",
     .field = CLOSED "u = -1 -1 -1 -1 -1 -1 |v = -1.73205 -1.73205 |units 'kn'"},
    {.what = "columns by names",
     .text = CHOICES,
     .options = {.vars = "a,b,wave_u,wave_v"},
     .field = "u = 5 5 5 5\n"},
    /* the only cell has a corner of no sea */
    {.what = "columns by numbers, and a mask",
     .options = {.vars = "1,2,4,3", .mask = "ice"},
     .status = FG_STATUS_ARGUMENT,
     .refused = ""},
    MALFORMED("x,y,u,v\n1,2,3,4\n1,3,abc,4\n2,2,3,4\n2,3,3,4\n",
              "line 3, column 3 (u): \"abc\" is no number"),
    MALFORMED("x,y,u,v\n1,2,oops,4\n1,3,3,4\n2,2,3,4\n2,3,3,4\n",
              "line 2, column 3: \"oops\" is no number"),
    MALFORMED("x,y,u,v\n1,2,3,4\n1,3,3\n2,2,3,4\n2,3,3,4\n",
              "line 3 has 3 columns, not 4"),
    MALFORMED("x,y,u,v\n1,2,3,4\n1,3,3,4\n2,2,3,4,5\n2,3,3,4\n",
              "line 4 has more than 4 columns"),
    MALFORMED("Dear reader,\nthis is a letter.\n",
              "is text, but no table of points: line 1 has 2 columns, 0 of them numbers"),
    MALFORMED("x;y;u;v\n1.000,5;2.000,5;0,5;0,25\n1.100,5;2.000,5;0,5;0,25\n",
              "line 2, column 1 (x): \"1.000,5\" is no number"),
    MALFORMED("Station,Latitude,Longitude,u,v\nname,deg,deg,m/s,m/s\nS1,51.2N,14.1W,1,2\n"
              "S2,50.2N,4.1E,1,2\nS3,50.2S,4.1E,1,2\n",
              "line 3, column 2 (Latitude): \"51.2N\" is no number"),
    MALFORMED("when it was so long\nand 3 days went by\nuntil it was 7 again\n",
              "line 2, column 1 (when): \"and\" is no number"),
    MALFORMED("one two three four\nfive six seven eight\n",
              "line 1 has 4 columns, 0 of them numbers"),
    MALFORMED("x,y,u,v\n", "a table with the names of 4 columns, and without rows"),
    MALFORMED("of 2 or 3 ways\nthe 1 that is new\nwent 4 miles on\nand 5 miles back\n",
              "is text, but no table of points: line 1 has 5"),
    MALFORMED("1 2 3\n4 5 6\n", "line 1 has 3 columns, 3 of them"),
    REFUSED("1 2 3 4 5\n2 3 4 5 6\n1 3 4 5 6\n", FG_STATUS_UNSUPPORTED,
            "no vectors found among its 5 variables: 1, 2, 3, 4, 5"),
    REFUSED("x,y,z,u,v,w\n1,2,3,4,1,1\n1,3,3,4,1,1\n2,2,9,4,1,1\n5,3,5,3,4,1\n",
            FG_STATUS_UNSUPPORTED, "4 points in space lie neither on a grid"),
    REFUSED("x,y,p,q\n1,2,3,4\n1,3,3,4\n2,2,3,4\n", FG_STATUS_UNSUPPORTED,
            "no vectors found among its 4 variables: x, y, p, q"),
    {.what = "has no variable 'w'",
     .text = "x,y,u,v\n1,2,3,4\n1,3,3,4\n2,2,3,4\n",
     .options = {.vars = "u,w"},
     .status = FG_STATUS_ARGUMENT,
     .refused = "has no variable 'w'"},
    REFUSED("x,y,a_u,a_v,b_u,b_v\n1,2,3,4,5,6\n1,3,3,4,5,6\n2,2,3,4,5,6\n",
            FG_STATUS_ARGUMENT,
            "2 vectors, and it is not clear which is meant: a_u,a_v; b_u,b_v"),
    REFUSED(
        "lon,lat,u,v\n-3.1,-1.5,3,4\n3.1,-1.5,3,4\n-3.1,1.5,3,4\n3.1,1.5,3,4\n0,0,1,1\n",
        FG_STATUS_ARGUMENT, "latitudes -1.5 to 1.5 are radians, not degrees"),
    REFUSED("x,y,u (m/s),v (cm/s)\n1,2,3,4\n1,3,3,4\n2,2,3,4\n2,3,3,4\n",
            FG_STATUS_UNSUPPORTED, "'u' is in m/s, 'v' in cm/s"),
    MALFORMED("lon,lat,u,v\n1,2,3,4\n1,3,3,4\n2,92,3,4\n2,3,3,4\n",
              "line 4: longitude 2, latitude 92"),
    MALFORMED("VARIABLES = x y u v\nZONE I=2 J=2 DATAPACKING=BLOCK\n1 2 3 4\n1 3 3 4\n",
              "line 5: is no number: "),
    MALFORMED("VARIABLES = x y u v\nZONE I=2 J=2\n1 2 3 4\n2 2 3 4\n1 3 3 4\n2 3 3 4\n"
              "ZONE I=2 J=2\n1 2 3 4\n",
              "line 9: is no number: "),
    MALFORMED("x,y,u,v\n1,2,3,4\n1,3,3,4\n1e400,2,3,4\n",
              "line 4: the point's coordinate 1 is inf"),
};

static void tables_are_read_or_refused(void **state)
{
  check_texts(*state, SITUATIONS, sizeof SITUATIONS / sizeof *SITUATIONS);
}

static void other_formats_are_left_alone(void **state)
{
  static const char *const others[] = {
      "<?xml version=\"1.0\"?>", "{\"type\": 1}", " \n\t",      "CDF\001",
      "[[1, 2, 3, 4]]",          "[1, 2]",        "[\"x\", 1]", "[",
      "\x89PNG\r\n\x1a"};
  for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
    assert_false(
        fg__format_table.is_mine((const unsigned char *)others[i], strlen(others[i])));
  (void)state;
}

/* A file cut off anywhere is a shorter table or refused. */
static void a_file_may_end_anywhere(void **state)
{
  static const char text[] =
      "lon [deg];lat [deg];u (m/s);v (m/s)\n1,5;2,5;0,5;1e-1\n3;2;\"1\";-1\n"
      "2;3;1;inf\n1;5;NaN;2\n7;1;2;2\n4;2;3;8\n";
  static const fg_read_options options = {0};
  int were_read = 0;
  for (size_t size = 1; size < sizeof text; ++size) {
    char *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, text, size);
    const fg__source source = {
        .path = "cut", .bytes = (const unsigned char *)copy, .size = size};
    fg_field *field = NULL;
    const fg_status status = fg__dataset_read(&field, *state, &fg__format_table, &source,
                                              &options, (fg__slab_index){0, 1});
    assert_int_equal(status == FG_STATUS_OK, field != NULL);
    assert_true(status == FG_STATUS_OK || fg_context_message(*state)[0]);
    were_read += status == FG_STATUS_OK;
    fg_field_destroy(field);
    fg_context_clear(*state);
    free(copy);
  }
  assert_true(were_read > 0);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(tables_are_read_or_refused),
      cmocka_unit_test(other_formats_are_left_alone),
      cmocka_unit_test(a_file_may_end_anywhere),
  };
  return cmocka_run_group_tests(tests, context_set_up, context_tear_down);
}

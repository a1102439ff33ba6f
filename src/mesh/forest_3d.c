#include <p4est_to_p8est.h>

#include "mesh/forest_body.h"

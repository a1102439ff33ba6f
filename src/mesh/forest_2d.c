#include "mesh/forest_body.h"

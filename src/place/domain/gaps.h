/* Gaps in data: holes that are small beside the picture, but so many that hardly a line
 * would find a way between them, as the missing samples of radars and swaths. */
#ifndef FG__PLACE_GAPS_H
#define FG__PLACE_GAPS_H

#include "place/domain/domain.h"

/* Makes a field without the gaps of a domain's, in which their samples are means of those
 * around. *out is NULL where there are none or most are in straight walls, and in 3D.
 * MEMORY. */
fg_status fg__place_fill_gaps(fg_field **out, fg_context *context,
                              const fg__place_domain *domain);

#endif

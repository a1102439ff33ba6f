/* The line of an icon: the piece of the streamline through its seed. */
#ifndef FG__PLACE_LINE_H
#define FG__PLACE_LINE_H

#include "place/scale.h"
#include "place/streamline.h"

enum { FG__PLACE_SAMPLES = 40 };

/* Where an icon lies: a point and how far its line may go from there, up and down the
 * stream. */
typedef struct fg__place_seed {
  double position[3];
  double way[2]; /* against the flow, along it */
} fg__place_seed;

typedef struct fg__place_line {
  int count; /* of samples from tail to tip, at most `sampling` apart; 0: there is none */
  int seed;  /* the sample at the seed */
  double length;
  float position[3][FG__PLACE_SAMPLES]; /* from the domain's low corner, in lambda */
  float tangent[3][FG__PLACE_SAMPLES];  /* unit */
  float share[FG__PLACE_SAMPLES];       /* of a full sampling step that a sample stands
                                           for */
  double way[2];                        /* how far it really goes */
} fg__place_line;

/* The end of a step of a line. */
typedef struct fg__place_step {
  fg__place_tip at;
  double clearance;
  double turned[3];  /* sum of turns as vectors, radians */
  double trial_step; /* that of the pair at first in the next step */
} fg__place_step;

/* The steps by `sampling` that lines from one place have taken, to either side of it. */
typedef struct fg__place_steps {
  int count[2];
  fg__place_step step[2][FG__PLACE_SAMPLES];
} fg__place_steps;

static inline void fg__place_no_steps(fg__place_steps *steps)
{
  steps->count[0] = steps->count[1] = 0;
}

/* Traces the line of a seed: it ends at the seed's ways; before a wall, once it comes
 * nearer than the clearance and still nears it; where it has turned by `turning`; before
 * a place where it breaks (75 degrees over 0.15 lambda) or reverses. count is 0 where the
 * seed is too near a wall or the line is too short. Bogacki and Shampine's embedded 3(2)
 * pair (1989) in arc length. */
void fg__place_trace(fg__place_line *out, const fg__place_domain *domain,
                     const fg__place_scale *scale, const fg__place_seed *seed);

/* The same, with the steps that lines of other ways from the same place have taken
 * before; those that it goes farther are added. */
void fg__place_trace_on(fg__place_line *out, const fg__place_domain *domain,
                        const fg__place_scale *scale, const fg__place_seed *seed,
                        fg__place_steps *steps);

/* A line for a picture: that which a search has found, with a hundredth of the error and
 * steps of an eighth, shorter where it turns by more than two degrees in one, and of
 * these the points that its shape needs (to 1e-4 lambda and a fifth of a degree);
 * where the flow turns over within a step, as in noise, the cubics through the line's
 * samples. *points is allocated, from tail to tip: free it. MEMORY. */
fg_status fg__place_trace_fine(double (**points)[3], int *count, fg_context *context,
                               const fg__place_domain *domain,
                               const fg__place_scale *scale, const fg__place_line *line);

/* The angle by which a polyline turns, radians: of the sum of its turns as vectors. */
double fg__place_turning(const double (*points)[3], int count);

/* Follows the streamline of a point until it has turned once round: how far from the
 * point it then is, and the diameter of its way. `radius` is about half of that. False
 * where it does not get round. */
bool fg__place_close(double *gap, double *diameter, const fg__place_domain *domain,
                     const fg__place_scale *scale, const double start[3], double radius);

/* Least distance to a wall that a line may have at a point, and least length there. */
double fg__place_least_clearance(const fg__place_domain *domain,
                                 const fg__place_scale *scale, const double position[3]);

#endif

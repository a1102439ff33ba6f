#include "field/still.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Speeds are counted by the first bits of a float: 16 bins to a factor of 2. */
enum { BIN_SHIFT = 19, BINS = 1 << (31 - BIN_SHIFT), BINS_TO_8 = 3 * 16 };

/* At least one in FEWEST of the samples that move reaches a typical speed. A vessel fills
 * 1 % of its box; within a few samples of a singularity speeds leap. */
enum { FEWEST = 200 };

/* Of 24 measured, simulated and analytic fields the fastest has 28 times its typical
 * speed; of fields of charges, dipoles and wires some have 100,000 times. */
static const double BEYOND_TYPICAL = 30.0;

/* Shares of the top and of the usual speed. */
static const double STILL = 1e-3, SLOW = 0.1;

static uint32_t bin_of(float speed)
{
  uint32_t bits;
  memcpy(&bits, &speed, sizeof bits);
  return bits >> BIN_SHIFT;
}

/* Where the bin begins. */
static double bin_start(uint32_t bin)
{
  const uint32_t bits = bin << BIN_SHIFT;
  float speed;
  memcpy(&speed, &bits, sizeof speed);
  return (double)speed;
}

static double typical_speed(const uint32_t tally[BINS], uint32_t moving)
{
  uint32_t reach = 0, faster = 0, low = BINS;
  for (uint32_t bin = BINS; bin-- > 0;) {
    reach += tally[bin];
    while (low > 0 && low + BINS_TO_8 > bin)
      faster += tally[--low];
    if (2 * (uint64_t)reach >= faster && FEWEST * (uint64_t)reach >= moving)
      return bin_start(bin);
  }
  return 0.0;
}

double fg__top_speed(const float *speed, size_t count)
{
  uint32_t tally[BINS] = {0}, moving = 0;
  float greatest = 0.0F;
  for (size_t n = 0; n < count; ++n)
    if (speed[n] > 0.0F) {
      ++tally[bin_of(speed[n])];
      ++moving;
      greatest = speed[n] > greatest ? speed[n] : greatest;
    }
  return fmin((double)greatest, BEYOND_TYPICAL * typical_speed(tally, moving));
}

bool fg__moves(double speed, double top)
{
  return speed > STILL * top;
}

double fg__usual_speed(const float *speed, size_t count, double top)
{
  double squares = 0.0;
  size_t valid = 0;
  for (size_t n = 0; n < count; ++n)
    if (speed[n] >= 0.0F) {
      const double counted = fmin((double)speed[n], top);
      squares += counted * counted;
      ++valid;
    }
  return valid > 0 ? sqrt(squares / (double)valid) : 0.0;
}

double fg__slow_share(const float *speed, size_t count, double usual)
{
  size_t valid = 0, slow = 0;
  for (size_t n = 0; n < count; ++n) {
    valid += speed[n] >= 0.0F;
    slow += speed[n] >= 0.0F && (double)speed[n] < SLOW * usual;
  }
  return valid > 0 ? (double)slow / (double)valid : 0.0;
}

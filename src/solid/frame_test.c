#include "base/context_test.h"
#include "base/vector.h"
#include "solid/frame.h"

enum { LARGEST = 241 };
static const double RADIUS = 1.7, PITCH = 0.6; /* of height a radian */

static void helix(double angle, double point[3])
{
  point[0] = RADIUS * cos(angle) - 3.0;
  point[1] = PITCH * angle + 1.0;
  point[2] = RADIUS * sin(angle);
}

/* Angle from the first normal to the last, about the tangent, when seen in the frame of
 * Frenet: a frame that does not twist turns there by minus the torsion times the length.
 */
static double turned(int count, double last_angle)
{
  static double point[LARGEST][3], tangent[LARGEST][3], normal[LARGEST][3];
  assert_true(count <= LARGEST);
  for (int n = 0; n < count; ++n) {
    double share = (double)n / (count - 1);
    /* unevenly apart */
    helix(last_angle * (share + 0.1 * share * (1 - share)), point[n]);
  }
  fg__frame_along((const double(*)[3])point, count, tangent, normal);
  double angle[2];
  for (int end = 0; end < 2; ++end) {
    int n = end ? count - 1 : 0;
    double at = end ? last_angle : 0.0;
    const double inward[3] = {-cos(at), 0.0, -sin(at)};
    double binormal[3];
    assert_true(fabs(fg__dot(normal[n], tangent[n])) < 1e-12);
    assert_true(fabs(fg__length(normal[n]) - 1.0) < 1e-12);
    fg__cross(tangent[n], inward, binormal);
    angle[end] = atan2(fg__dot(normal[n], binormal), fg__dot(normal[n], inward));
  }
  return angle[1] - angle[0];
}

static double error_of(int count)
{
  double last = 9.0, square = RADIUS * RADIUS + PITCH * PITCH;
  double torsion = PITCH / square, length = last * sqrt(square);
  /* turning from x to z about y is left-handed */
  double error = turned(count, last) - torsion * length;
  return fabs(remainder(error, 6.283185307179586));
}

static void a_frame_on_a_helix_does_not_twist(void **state)
{
  (void)state;
  double coarse = error_of(61), fine = error_of(241);
  assert_true(coarse < 0.02);
  assert_true(fine < coarse / 8.0); /* tangents of second order: four times finer, 16 */
}

/* In a plane the normal that is in it stays in it, through a loop and a bend back. */
static void a_frame_in_a_plane_stays_in_it(void **state)
{
  (void)state;
  enum { COUNT = 200 };
  double point[COUNT][3], tangent[COUNT][3], normal[COUNT][3];
  for (int n = 0; n < COUNT; ++n) {
    double s = 0.06 * n;
    const double across[3] = {0.36, 0.48, -0.8}, along[3] = {0.8, -0.6, 0.0};
    for (int k = 0; k < 3; ++k)
      point[n][k] = (s + 0.5 * sin(3.0 * s)) * along[k] + 1.3 * cos(2.0 * s) * across[k];
  }
  const double up[3] = {0.48, 0.64, 0.6};
  fg__frame_along((const double(*)[3])point, COUNT, tangent, normal);
  double before = fg__dot(normal[0], up);
  for (int n = 1; n < COUNT; ++n)
    assert_true(fabs(fg__dot(normal[n], up) - before) < 1e-9);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_frame_on_a_helix_does_not_twist),
      cmocka_unit_test(a_frame_in_a_plane_stays_in_it),
  };
  return cmocka_run_group_tests_name("solid/frame", tests, NULL, NULL);
}

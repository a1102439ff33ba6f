#include "icon/arrow.h"

#include "base/memory.h"
#include "icon/outline/smooth_line.h"

#include <math.h>
#include <stdlib.h>

/* Half widths stay below this share of the radius of curvature: at 1 the inner side's
 * offset would turn back on itself. Arrows made here stay below it anyway; this is for
 * icons that were read from elsewhere. */
static const double LARGEST_BEND = 0.9;

/* Normals are those of the chord over this many widths to either side: a body then glides
 * over bends that are tighter than itself, as a brush does. */
static const double CHORD_REACH = 0.75;

/* A head is a straight triangle as long as its ends lie apart by this share of the line
 * between them; round a tighter bend it turns with the line. */
static const double STRAIGHT_HEAD = 0.7;

/* Below this share, a bend of 75 degrees, swept barbs would cut the body: they are not
 * swept. */
static const double SWEPT_HEAD = 0.93;

/* Vertices that round the tail's end, on each side: 18 degrees each. */
enum { TAIL_VERTICES = 5 };

static const double QUARTER_TURN = 1.5707963267948966;

/* The centreline with what its offsets need at each point. */
typedef struct centerline {
  const double (*point)[3];
  int count;
  double *s;           /* arc length */
  double (*normal)[2]; /* unit, to the left */
  double (*smooth)[2]; /* the point itself, smoothed as the normals are */
  double *limit;       /* largest half width */
} centerline;

/* Polygon under construction: left side forwards, right side to be turned round. */
typedef struct outline_sides {
  double (*left)[2];
  double (*right)[2];
  int count;
} outline_sides;

static void find_arc_lengths(centerline *line)
{
  line->s[0] = 0;
  for (int i = 1; i < line->count; i++)
    line->s[i] = line->s[i - 1] + hypot(line->point[i][0] - line->point[i - 1][0],
                                        line->point[i][1] - line->point[i - 1][1]);
}

/* Slope at point i of the parabola through it and its neighbours b before, c after. */
static void find_slope(const centerline *line, int i, int b, int c, double slope[2])
{
  double h = line->s[b + 1] - line->s[b], k = line->s[c] - line->s[c - 1];
  for (int a = 0; a < 2; a++) {
    double first = (line->point[b + 1][a] - line->point[b][a]) / h;
    double second = (line->point[c][a] - line->point[c - 1][a]) / k;
    double bend = (second - first) / (h + k);
    if (i == b)
      slope[a] = first - bend * h;
    else if (i == c)
      slope[a] = second + bend * k;
    else
      slope[a] = first + bend * h;
  }
}

/* Moves *segment to the segment of arc length s. */
static void find_segment(const centerline *line, double s, int *segment)
{
  while (*segment > 0 && line->s[*segment] > s)
    --*segment;
  while (*segment < line->count - 2 && line->s[*segment + 1] < s)
    ++*segment;
}

/* Point of the line at arc length s; *segment is where to look. */
static void point_at(const centerline *line, double s, int *segment, double point[2])
{
  find_segment(line, s, segment);
  int i = *segment;
  double t = (s - line->s[i]) / (line->s[i + 1] - line->s[i]);
  for (int a = 0; a < 2; a++)
    point[a] = (1 - t) * line->point[i][a] + t * line->point[i + 1][a];
}

/* Mean of the line from one arc length to another, within the segments given. */
static void mean_between(const centerline *line, double from, double to, int first,
                         double mean[2])
{
  double before[2], after[2];
  int segment = first;
  point_at(line, from, &segment, before);
  mean[0] = mean[1] = 0;
  double s = from;
  while (s < to) {
    double next = fmin(line->s[segment + 1], to);
    if (segment == line->count - 2)
      next = to;
    int at = segment;
    point_at(line, next, &at, after);
    for (int a = 0; a < 2; a++) {
      mean[a] += (before[a] + after[a]) / 2 * (next - s) / (to - from);
      before[a] = after[a];
    }
    s = next;
    segment++;
  }
}

/* Normals of the chords; at the ends of the line, where there is none, of its slope. */
static void find_normals(centerline *line, double width)
{
  int n = line->count, before = 0, after = 0;
  double length = line->s[n - 1];
  for (int i = 0; i < n; i++) {
    double slope[2];
    line->smooth[i][0] = line->point[i][0];
    line->smooth[i][1] = line->point[i][1];
    double reach = fmin(CHORD_REACH * width, fmin(line->s[i], length - line->s[i]));
    if (n == 2) {
      slope[0] = line->point[1][0] - line->point[0][0];
      slope[1] = line->point[1][1] - line->point[0][1];
    } else if (reach > 0 && i > 0 && i < n - 1) {
      double from[2], to[2];
      point_at(line, line->s[i] - reach, &before, from);
      point_at(line, line->s[i] + reach, &after, to);
      slope[0] = to[0] - from[0];
      slope[1] = to[1] - from[1];
      mean_between(line, line->s[i] - reach, line->s[i] + reach, before, line->smooth[i]);
    } else {
      int middle = i == 0 ? 1 : i == n - 1 ? n - 2 : i;
      find_slope(line, i, middle - 1, middle + 1, slope);
    }
    double size = hypot(slope[0], slope[1]);
    if (!(size > 0)) { /* the line turns straight back: any normal will do */
      slope[0] = size = 1;
      slope[1] = 0;
    }
    line->normal[i][0] = -slope[1] / size;
    line->normal[i][1] = slope[0] / size;
  }
}

static void find_limits(centerline *line)
{
  for (int i = 0; i < line->count; i++) {
    int before = i > 0 ? i - 1 : i, after = i < line->count - 1 ? i + 1 : i;
    const double *a = line->normal[before], *b = line->normal[after];
    double turn = fabs(atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]));
    double length = line->s[after] - line->s[before];
    line->limit[i] = turn * length > 0 ? LARGEST_BEND * length / turn : HUGE_VAL;
  }
}

/* Adds the two vertices at arc length s and half width w; *segment is where to look. */
static void add_pair(outline_sides *sides, const centerline *line, double s, double w,
                     int *segment)
{
  find_segment(line, s, segment);
  int i = *segment;
  double t = (s - line->s[i]) / (line->s[i + 1] - line->s[i]);
  double normal[2], size;
  for (int a = 0; a < 2; a++)
    normal[a] = (1 - t) * line->normal[i][a] + t * line->normal[i + 1][a];
  size = hypot(normal[0], normal[1]);
  if (!(size > 0))
    size = 1;
  w = fmin(w, fmin(line->limit[i], line->limit[i + 1]));
  for (int a = 0; a < 2; a++) {
    double center = (1 - t) * line->smooth[i][a] + t * line->smooth[i + 1][a];
    sides->left[sides->count][a] = center + w * normal[a] / size;
    sides->right[sides->count][a] = center - w * normal[a] / size;
  }
  sides->count++;
}

/* Body half width at arc length s: straight taper. */
static double body_half_width(const fg_icon *icon, double s, double body_length)
{
  double t = body_length > 0 ? s / body_length : 1;
  return (icon->tail_width + (icon->width - icon->tail_width) * t) / 2;
}

/* Adds the barbs of a straight head; false when the line bends too much for one. */
static bool add_straight_head(outline_sides *sides, const centerline *line, double body,
                              double width)
{
  int last = line->count - 1, segment = last - 1;
  double base[2];
  point_at(line, body, &segment, base);
  const double *tip = line->point[last];
  double axis[2] = {tip[0] - base[0], tip[1] - base[1]};
  double length = hypot(axis[0], axis[1]);
  const double share = length / (line->s[last] - body);
  if (!(share > STRAIGHT_HEAD))
    return false;
  const double sweep = share > SWEPT_HEAD ? FG__HEAD_SWEEP : 0.0;
  axis[0] /= length;
  axis[1] /= length;
  for (int a = 0; a < 2; a++) {
    double normal = a == 0 ? -axis[1] : axis[0];
    double barb = base[a] - sweep * length * axis[a];
    sides->left[sides->count][a] = barb + width / 2 * normal;
    sides->right[sides->count][a] = barb - width / 2 * normal;
  }
  sides->count++;
  return true;
}

static void trace_sides(outline_sides *sides, const centerline *line, const fg_icon *icon)
{
  double length = line->s[line->count - 1];
  /* a foreign icon may be all head: leave it some body */
  double head = fmin(icon->head_length, 0.9 * length / (1 + FG__HEAD_SWEEP));
  double body = length - head, barb = body - FG__HEAD_SWEEP * head;
  double cap = fmin(icon->tail_width / 2, body / 2);
  int segment = 0;
  for (int i = 1; i <= TAIL_VERTICES; i++) {
    double angle = QUARTER_TURN * i / TAIL_VERTICES;
    double s = cap * (1 - cos(angle));
    add_pair(sides, line, s, body_half_width(icon, s, body) * sin(angle), &segment);
  }
  for (int i = 1; i < line->count - 1; i++)
    if (line->s[i] > cap && line->s[i] < body)
      add_pair(sides, line, line->s[i], body_half_width(icon, line->s[i], body),
               &segment);
  add_pair(sides, line, body, icon->width / 2, &segment);
  if (add_straight_head(sides, line, body, icon->head_width))
    return;
  add_pair(sides, line, barb, icon->head_width / 2, &segment);
  for (int i = 1; i < line->count - 1; i++)
    if (line->s[i] > barb)
      add_pair(sides, line, line->s[i],
               icon->head_width / 2 * (length - line->s[i]) / (length - barb), &segment);
}

static bool is_drawable(const fg_icon *icon)
{
  if (!icon->points || icon->point_count < 2)
    return false;
  double numbers[] = {icon->width, icon->tail_width, icon->head_length, icon->head_width};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
    if (!(numbers[i] >= 0) || !isfinite(numbers[i]))
      return false;
  for (int i = 0; i < icon->point_count; i++) {
    if (!isfinite(icon->points[i][0]) || !isfinite(icon->points[i][1]))
      return false;
    if (i > 0 && icon->points[i][0] == icon->points[i - 1][0] &&
        icon->points[i][1] == icon->points[i - 1][1])
      return false;
  }
  return true;
}

static fg_status outline_of(const fg_icon *icon, double (**vertices)[2], int *count)
{
  size_t n = (size_t)icon->point_count;
  /* each point is met at most twice a side, where head and body overlap */
  size_t side = 2 * n + TAIL_VERTICES + 2;
  fg_status status = FG_STATUS_MEMORY;
  double(*polygon)[2] = NULL;
  centerline line = {.point = icon->points, .count = icon->point_count};
  outline_sides sides = {0};
  line.s = fg__allocate(n, sizeof *line.s);
  line.normal = fg__allocate(n, sizeof *line.normal);
  line.smooth = fg__allocate(n, sizeof *line.smooth);
  line.limit = fg__allocate(n, sizeof *line.limit);
  sides.left = fg__allocate(side, sizeof *sides.left);
  sides.right = fg__allocate(side, sizeof *sides.right);
  polygon = fg__allocate(2 * side + 2, sizeof *polygon);
  if (!line.s || !line.normal || !line.smooth || !line.limit || !sides.left ||
      !sides.right || !polygon)
    goto cleanup;

  find_arc_lengths(&line);
  find_normals(&line, icon->width);
  find_limits(&line);
  trace_sides(&sides, &line, icon);

  int total = 0;
  for (int a = 0; a < 2; a++)
    polygon[total][a] = icon->points[0][a];
  total++;
  for (int i = 0; i < sides.count; i++, total++)
    for (int a = 0; a < 2; a++)
      polygon[total][a] = sides.left[i][a];
  for (int a = 0; a < 2; a++)
    polygon[total][a] = icon->points[n - 1][a];
  total++;
  for (int i = sides.count - 1; i >= 0; i--, total++)
    for (int a = 0; a < 2; a++)
      polygon[total][a] = sides.right[i][a];
  *vertices = polygon;
  *count = total;
  polygon = NULL;
  status = FG_STATUS_OK;
cleanup:
  free(line.s);
  free(line.normal);
  free(line.smooth);
  free(line.limit);
  free(sides.left);
  free(sides.right);
  free(polygon);
  return status;
}

fg_status fg_icon_outline(const fg_icon *icon, double (**vertices)[2], int *count)
{
  if (!icon || !vertices || !count)
    return FG_STATUS_ARGUMENT;
  *vertices = NULL;
  *count = 0;
  if (!is_drawable(icon))
    return FG_STATUS_ARGUMENT;
  fg_icon drawn = *icon;
  double(*smooth)[3] = NULL;
  int points = 0;
  if (!fg__icon_smooth(&smooth, &points, icon))
    return FG_STATUS_MEMORY;
  if (smooth) {
    drawn.points = (const double(*)[3])smooth;
    drawn.point_count = points;
  }
  fg_status status = outline_of(&drawn, vertices, count);
  free(smooth);
  return status;
}

/* Whatever a reader's tests read is read once more by slabs: together these must be the
 * whole, to the bit, or be refused as it is. */
#ifndef FG__SLABS_ALIKE_TEST_H
#define FG__SLABS_ALIKE_TEST_H

#include <string.h>

#include "base/context_test.h"
#include "field/fingerprint.h"
#include "field/slab.h"
#include "read/format.h"
#include "read/title.h"

static inline void assert_same_text(const char *a, const char *b)
{
  assert_true((a == NULL) == (b == NULL));
  if (a && b)
    assert_string_equal(a, b);
}

static inline void assert_same_grid(const fg_field *one, const fg_field *other)
{
  const fg_field_arrays *a = fg_field_contents(one), *b = fg_field_contents(other);
  assert_int_equal(a->dimension, b->dimension);
  assert_int_equal(a->scale, b->scale);
  for (int k = 0; k < a->dimension; ++k) {
    assert_int_equal(a->size[k], b->size[k]);
    assert_memory_equal(a->axis[k], b->axis[k], (size_t)a->size[k] * sizeof(double));
    assert_true(a->period[k] == b->period[k]);
    assert_same_text(a->velocity_name[k], b->velocity_name[k]);
    assert_same_text(a->axis_name[k], b->axis_name[k]);
    assert_same_text(a->axis_units[k], b->axis_units[k]);
  }
  assert_same_text(a->velocity_units, b->velocity_units);
  assert_same_text(a->title, b->title);
  assert_same_text(a->time, b->time);
  assert_same_text(a->level, b->level);
}

/* A slab has the rows of the whole that it should have. */
static inline void assert_same_rows(const fg_field *slab, const fg_field *whole)
{
  const int last = fg__field_last_axis(whole), rows = whole->axis[last].samples;
  const size_t row = fg__field_held(whole) / (size_t)rows;
  const int first = slab->first[last], held = slab->held[last];
  assert_true(first >= 0 && first + held <= rows);
  if (slab->slab)
    assert_int_equal(held, slab->slab->own + (first + slab->slab->own < rows));
  else
    assert_int_equal(held, rows);
  for (int k = 0; k <= last; ++k)
    assert_memory_equal(slab->velocity[k], whole->velocity[k] + row * (size_t)first,
                        row * (size_t)held * sizeof(float));
}

static inline void add_counts(fg__slab_counts *sum, const fg__slab_counts *counts)
{
  uint64_t a[sizeof *sum / sizeof(uint64_t)], b[sizeof *sum / sizeof(uint64_t)];
  memcpy(a, sum, sizeof a);
  memcpy(b, counts, sizeof b);
  for (size_t n = 0; n < sizeof a / sizeof *a; ++n)
    a[n] += b[n];
  memcpy(sum, a, sizeof a);
}

/* What all slabs together are refused for. */
static inline bool counts_are_good(const fg__slab_counts *all)
{
  for (int k = 0; k < 3; ++k)
    if (all->samples ==
        all->by_reason[k][0] + all->by_reason[k][1] + all->by_reason[k][2])
      return false;
  return fg__field_check_counts(NULL, all) == FG_STATUS_OK;
}

/* whole: what reading the source gave; NULL: it was refused. Then slabs at both ends and
 * between them tell. Of small fields five are more than there are rows. */
static inline void assert_slabs_alike(const fg__format *format, const fg__source *source,
                                      const fg_read_options *options,
                                      const fg_field *whole)
{
  fg_context *context;
  assert_int_equal(fg_context_create(&context), FG_STATUS_OK);
  for (int count = whole ? 2 : 3; count <= 5; count += 3) {
    fg__slab_counts all = {0};
    bool read = true, slab = true;
    for (int number = 0; number < count; ++number) {
      fg_field *part = NULL;
      const fg_status status = fg__dataset_read(&part, context, format, source, options,
                                                (fg__slab_index){number, count});
      assert_true((part != NULL) == (status == FG_STATUS_OK));
      read = read && part;
      if (part && whole) {
        assert_int_equal(fg__title_from_file(part, context, source, options),
                         FG_STATUS_OK);
        assert_same_grid(part, whole);
        assert_same_rows(part, whole);
      }
      slab = slab && part && part->slab;
      if (part && part->slab)
        add_counts(&all, &part->slab->counts);
      fg_field_destroy(part);
    }
    if (whole && !read)
      fail_msg("by %d parts: %s", count, fg_context_message(context));
    if (!whole && read)
      assert_true(slab && !counts_are_good(&all));
    if (whole && slab) {
      assert_true(counts_are_good(&all));
      assert_int_equal(fg__field_fingerprint_grid(whole) + all.fingerprint,
                       fg__field_fingerprint(whole));
      assert_int_equal(all.samples, fg__field_held(whole));
    }
  }
  fg_context_destroy(context);
}

#endif

#include "grid/field_slabs.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/mix.h"
#include "field/fingerprint.h"

/* What all ranks must have in common; a whole field has no key. */
static uint64_t key_of(const fg_field *field)
{
  const fg__field_slab *slab = field->slab;
  return slab ? fg__mix(slab->key ^ (uint64_t)slab->count) : 0;
}

static fg_status check_parts(fg_context *context, const fg__ranks *ranks,
                             const fg_field *field)
{
  const fg__field_slab *slab = field->slab;
  fg_status status = FG_STATUS_OK;
  if (slab && (slab->number != ranks->rank || slab->count != ranks->count))
    status =
        fg__fail(context, FG_STATUS_ARGUMENT, "field: rank %d of %d has part %d of %d",
                 ranks->rank, ranks->count, slab->number, slab->count);
  status = fg__ranks_agree(ranks, context, status);
  if (status == FG_STATUS_OK && !fg__ranks_alike(ranks, key_of(field)))
    status = fg__fail(context, FG_STATUS_ARGUMENT, "the %d ranks have different fields",
                      ranks->count);
  return status;
}

/* As a reader would have said it of the whole. */
static fg_status check_reasons(fg_context *context, const fg_field *field,
                               const fg__slab_counts *all)
{
  for (int k = 0; k < field->contents.dimension && field->slab->has_reasons; ++k) {
    const uint64_t *missing = all->by_reason[k];
    if (missing[0] + missing[1] + missing[2] == all->samples)
      return fg__fail(context, FG_STATUS_FILE_FORMAT,
                      "%s: all %" PRIu64 " samples of '%s' are missing (%" PRIu64
                      " fill values, %" PRIu64 " outside the valid range, %" PRIu64
                      " not a number)",
                      field->slab->input, all->samples, field->contents.velocity_name[k],
                      missing[0], missing[1], missing[2]);
  }
  return FG_STATUS_OK;
}

/* What is wrong with the samples of a file is said of the file. */
static fg_status check_counts(fg_context *context, const fg_field *field,
                              const fg__slab_counts *all)
{
  static const char prefix[] = "field: ";
  enum { MESSAGE_BYTES = 512 };
  fg_status status = check_reasons(context, field, all);
  if (status == FG_STATUS_OK)
    status = fg__field_check_counts(context, all);
  const char *message = fg_context_message(context);
  if (status == FG_STATUS_OK || !field->slab->input ||
      strncmp(message, prefix, sizeof prefix - 1) != 0)
    return status;
  char words[MESSAGE_BYTES];
  strncpy(words, message + sizeof prefix - 1, sizeof words - 1);
  words[sizeof words - 1] = '\0';
  fg_context_clear(context);
  return fg__fail(context, FG_STATUS_FILE_FORMAT, "%s: %s", field->slab->input, words);
}

typedef struct mask {
  unsigned char *bits; /* NULL: not of this rank */
  size_t count, capacity;
} mask;

static void take_bits(void *closure, const unsigned char *bytes, size_t count)
{
  mask *m = closure;
  if (m->bits && count <= m->capacity - m->count)
    memcpy(m->bits + m->count, bytes, count);
  m->count += count;
}

/* Brings to rank 0 a bit for each sample: pictures show where the field is missing. */
static fg_status collect_mask(fg_context *context, const fg__ranks *ranks,
                              fg_field *field)
{
  fg__field_slab *slab = field->slab;
  const size_t columns = (size_t)field->held[0], rows = (size_t)slab->own;
  const size_t row = (columns + CHAR_BIT - 1) / CHAR_BIT;
  mask all = {.capacity = row * (size_t)field->contents.size[1]};
  unsigned char *own = fg__allocate(rows, row);
  fg_status status = FG_STATUS_OK;
  if (ranks->rank == 0)
    all.bits = fg__allocate(all.capacity, 1);
  if (!own || (ranks->rank == 0 && !all.bits))
    status = fg__fail_memory(context, "the mask", rows * row + all.capacity);
  status = fg__ranks_agree(ranks, context, status);
  if (status == FG_STATUS_OK) {
    for (size_t j = 0; j < rows; ++j)
      for (size_t i = 0; i < columns; ++i)
        if (!isnan(field->velocity[0][j * columns + i]))
          own[j * row + i / CHAR_BIT] |= (unsigned char)(1U << (i % CHAR_BIT));
    fg__ranks_pass(ranks, own, rows * row, take_bits, &all);
    slab->valid = all.bits;
  } else {
    free(all.bits);
  }
  free(own);
  return status;
}

fg_status fg__field_join(fg_context *context, const fg__ranks *ranks, fg_field *field)
{
  fg__field_slab *slab = field->slab;
  fg_status status = check_parts(context, ranks, field);
  if (status != FG_STATUS_OK || !slab || slab->joined)
    return status;
  uint64_t sums[sizeof(fg__slab_counts) / sizeof(uint64_t)];
  fg__slab_counts all;
  memcpy(sums, &slab->counts, sizeof sums);
  fg__ranks_add(ranks, sums, sizeof sums / sizeof *sums);
  memcpy(&all, sums, sizeof all);
  status = check_counts(context, field, &all);
  if (status == FG_STATUS_OK && field->contents.dimension == 2 && all.missing > 0)
    status = collect_mask(context, ranks, field);
  if (status != FG_STATUS_OK)
    return status;
  slab->fingerprint = fg__field_fingerprint_grid(field) + all.fingerprint;
  field->infinite = all.infinite;
  field->missing = all.missing;
  slab->joined = true;
  return FG_STATUS_OK;
}

fg_status fg_field_join(fg_context *context, fg_field *field)
{
  if (!field)
    return fg__fail(context, FG_STATUS_ARGUMENT, "field: none to join");
  const fg__ranks *ranks = fg__ranks_of(context);
  fg_phase before = fg__phase_continue(ranks->counters, FG_PHASE_SETUP);
  fg_status status = fg__field_join(context, ranks, field);
  fg__phase_return(ranks->counters, before);
  return status;
}

fg_status fg__field_check_shared(fg_context *context, const fg__ranks *ranks,
                                 const fg_field *field)
{
  const fg__field_slab *slab = field->slab;
  fg_status status = FG_STATUS_OK;
  if (slab && (!slab->joined || slab->count != ranks->count))
    status = fg__fail(context, FG_STATUS_ARGUMENT,
                      "field: part %d of %d is not joined with those of %d ranks",
                      slab->number, slab->count, ranks->count);
  return fg__ranks_agree(ranks, context, status);
}

/* Who has which rows, as a partition of the samples. */
static fg_status deal(fg__partition *out, fg_context *context, const fg__ranks *ranks,
                      const fg_field *field)
{
  const fg_field_arrays *contents = &field->contents;
  const int last = fg__field_last_axis(field);
  *out = (fg__partition){.dimension = contents->dimension,
                         .ranks = ranks,
                         .blocks = {1, 1, 1},
                         .block = fg__allocate((size_t)ranks->count, sizeof *out->block)};
  if (!out->block)
    return fg__fail_memory(context, "the parts of a field",
                           (size_t)ranks->count * sizeof(fg__box));
  out->blocks[last] = ranks->count;
  for (int k = 0; k < 3; ++k) {
    bool used = k < contents->dimension;
    out->nodes[k] = used ? contents->size[k] : 1;
    out->cells[k] = used ? field->axis[k].cells : 1;
    out->periodic[k] = used && contents->period[k] > 0.0;
  }
  for (int r = 0; r < ranks->count; ++r) {
    fg__box *block = &out->block[r];
    memcpy(block->nodes, out->nodes, sizeof block->nodes);
    fg__slab_rows(&block->first[last], &block->nodes[last], contents->size[last], r,
                  ranks->count);
  }
  return FG_STATUS_OK;
}

/* One component of all windows. Collective. */
static fg_status fill_component(fg_context *context, const fg__partition *partition,
                                const fg_field *field, int k, const fg__region *region,
                                int count, float *const out[], void **place)
{
  const ptrdiff_t row = field->held[0];
  fg__region_source source = {.size = sizeof(float),
                              .first = field->velocity[k],
                              .row = row,
                              .plane = row * field->held[1]};
  for (int n = 0; n < count; ++n)
    place[n] = out[3 * n + k];
  return fg__regions_fill(context, partition, region, count, &source, place);
}

static fg_status allocate(float *out[], fg_context *context, const fg__ranks *ranks,
                          int dimension, const fg__region *region, int count)
{
  for (int n = 0; n < count; ++n)
    for (int k = 0; k < dimension && region[n].rank == ranks->rank; ++k) {
      size_t samples = (size_t)fg__box_count(&region[n].nodes);
      out[3 * n + k] = fg__allocate(samples, sizeof(float));
      if (!out[3 * n + k])
        return fg__fail_memory(context, "a window of the field", samples * sizeof(float));
    }
  return FG_STATUS_OK;
}

fg_status fg__field_windows(fg_field *out[], fg_context *context, const fg__ranks *ranks,
                            const fg_field *field, const fg__region *region, int count)
{
  const int dimension = field->contents.dimension;
  const size_t windows = (size_t)count;
  fg__partition partition = {0};
  float **velocity = fg__allocate(3 * windows, sizeof *velocity);
  void **place = fg__allocate(windows, sizeof *place);
  memset(out, 0, windows * sizeof *out);
  fg_status status = velocity && place ? deal(&partition, context, ranks, field)
                                       : fg__fail_memory(context, "windows of the field",
                                                         3 * windows * sizeof *velocity);
  if (status == FG_STATUS_OK)
    status = allocate(velocity, context, ranks, dimension, region, count);
  status = fg__ranks_agree(ranks, context, status);
  for (int k = 0; k < dimension && status == FG_STATUS_OK; ++k)
    status =
        fill_component(context, &partition, field, k, region, count, velocity, place);
  const bool filled = status == FG_STATUS_OK;
  for (int n = 0; n < count && velocity; ++n)
    if (filled && status == FG_STATUS_OK && region[n].rank == ranks->rank)
      status = fg__field_create_window(&out[n], context, field, region[n].nodes.first,
                                       region[n].nodes.nodes, velocity + (3 * n));
    else
      for (int k = 0; k < dimension; ++k)
        free(velocity[3 * n + k]);
  if (filled)
    status = fg__ranks_agree(ranks, context, status);
  for (int n = 0; n < count && status != FG_STATUS_OK; ++n) {
    fg_field_destroy(out[n]);
    out[n] = NULL;
  }
  fg__partition_clear(&partition);
  free(velocity);
  free(place);
  return status;
}

void fg__field_windows_destroy(fg_field **window, int count)
{
  for (int n = 0; window && n < count; ++n)
    fg_field_destroy(window[n]);
  free(window);
}

#include "read/isolate/wire.h"

#include "base/memory.h"
#include "field/slab.h"
#include "read/format.h"

#include <errno.h>
#include <poll.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

/* Interval, in milliseconds, at which a stop is detected. */
enum { LONGEST_WAIT = 100 };

static bool is_good(const fg__wire *wire)
{
  return wire->status == FG_STATUS_OK;
}

/* Counts bytes that were transferred. */
static void advance(fg__wire *wire, char **bytes, size_t *size, ssize_t count)
{
  if (count > 0) {
    *bytes += count;
    *size -= (size_t)count;
  } else if (count == 0 || errno != EINTR) {
    wire->status = FG_STATUS_FILE_ACCESS;
  }
}

static void send_bytes(fg__wire *wire, char *bytes, size_t size)
{
  while (size > 0 && is_good(wire))
    advance(wire, &bytes, &size, send(wire->socket, bytes, size, MSG_NOSIGNAL));
}

static void receive_bytes(fg__wire *wire, char *bytes, size_t size)
{
  while (size > 0 && is_good(wire)) {
    struct pollfd wait = {.fd = wire->socket, .events = POLLIN};
    const int ready = poll(&wait, 1, wire->context ? LONGEST_WAIT : -1);
    wire->status = fg__check_stop(wire->context);
    if (ready > 0 && is_good(wire))
      advance(wire, &bytes, &size, recv(wire->socket, bytes, size, 0));
  }
}

void fg__wire_bytes(fg__wire *wire, void *bytes, size_t size)
{
  (wire->sends ? send_bytes : receive_bytes)(wire, bytes, size);
}

/* Memory that the wire owns; NULL after a failure. */
static void *make_room(fg__wire *wire, size_t count, size_t size)
{
  void *owned = wire->owned;
  void *room = is_good(wire) ? fg__allocate(count, size) : NULL;
  if (room && fg__grow(&owned, &wire->capacity, wire->count + 1, sizeof room)) {
    wire->owned = owned;
    wire->owned[wire->count++] = room;
    return room;
  }
  free(room);
  if (is_good(wire))
    wire->status = fg__fail_memory(wire->context, "what was read", count);
  return NULL;
}

void fg__wire_clear(fg__wire *wire)
{
  for (size_t n = 0; n < wire->count; ++n)
    free(wire->owned[n]);
  free(wire->owned);
  wire->owned = NULL;
  wire->count = wire->capacity = 0;
}

/* Sends `count` things of a size, or makes room for them and receives them. */
static void pass_array(fg__wire *wire, const void **array, size_t count, size_t size)
{
  void *room = wire->sends ? (void *)(uintptr_t)*array : make_room(wire, count, size);
  if (room)
    fg__wire_bytes(wire, room, count * size);
  *array = room;
}

void fg__wire_text(fg__wire *wire, const char **text)
{
  size_t bytes = wire->sends && *text ? strlen(*text) + 1 : 0;
  const void *array = wire->sends ? *text : NULL;
  fg__wire_bytes(wire, &bytes, sizeof bytes);
  if (bytes)
    pass_array(wire, &array, bytes, 1);
  *text = array;
}

/* Times or levels of a vector; NULL where they are not known. */
static void pass_values(fg__wire *wire, const fg_axis_value **values, int count)
{
  const void *array = *values;
  bool are_known = *values != NULL;
  fg__wire_bytes(wire, &are_known, sizeof are_known);
  if (are_known && count > 0)
    pass_array(wire, &array, (size_t)count, sizeof **values);
  *values = are_known ? array : NULL;
  for (int n = 0; n < count && *values && is_good(wire); ++n) {
    fg_axis_value one = (*values)[n];
    fg__wire_text(wire, &one.units);
    fg__wire_text(wire, &one.words);
    if (!wire->sends)
      ((fg_axis_value *)(uintptr_t)*values)[n] = one;
  }
}

static void pass_vector(fg__wire *wire, fg_inventory_vector *vector)
{
  fg__wire_bytes(wire, vector, sizeof *vector);
  for (int n = 0; n < FG__VECTOR_TEXTS; ++n)
    fg__wire_text(wire, fg__vector_text(vector, n));
  pass_values(wire, &vector->time_value, vector->times);
  pass_values(wire, &vector->level_value, vector->levels);
}

void fg__wire_inventory(fg__wire *wire, fg_inventory **inventory)
{
  const char *format = wire->sends ? fg_inventory_format(*inventory) : NULL;
  int count = wire->sends ? fg_inventory_vector_count(*inventory) : 0;
  fg__wire_text(wire, &format);
  fg__wire_bytes(wire, &count, sizeof count);
  if (!wire->sends && is_good(wire))
    wire->status = fg__inventory_create(inventory, wire->context, format);
  for (int n = 0; n < count && is_good(wire); ++n) {
    fg_inventory_vector vector = {.components = 0};
    if (wire->sends)
      vector = *fg_inventory_vector_at(*inventory, n);
    pass_vector(wire, &vector);
    if (!wire->sends && is_good(wire))
      wire->status = fg__inventory_add(*inventory, wire->context, &vector);
  }
  if (!wire->sends && !is_good(wire)) {
    fg_inventory_destroy(*inventory);
    *inventory = NULL;
  }
}

/* A field without its samples. */
typedef struct field_facts {
  fg_field_arrays arrays;
  uint64_t missing, infinite;
  double normal_share;
  fg__field_slab slab; /* with a count of 0: the field is no slab */
} field_facts;

static void pass_facts(fg__wire *wire, field_facts *facts)
{
  fg_field_arrays *arrays = &facts->arrays;
  const char *input = facts->slab.input;
  fg__wire_bytes(wire, facts, sizeof *facts);
  for (int k = 0; k < arrays->dimension && k < 3; ++k) {
    const void *axis = arrays->axis[k];
    pass_array(wire, &axis, (size_t)arrays->size[k], sizeof(double));
    arrays->axis[k] = axis;
  }
  for (int n = 0; n < FG__FIELD_WORDS; ++n)
    fg__wire_text(wire, fg__arrays_word(arrays, n));
  fg__wire_text(wire, &input);
  facts->slab.input = (char *)(uintptr_t)input;
  facts->slab.valid = NULL; /* of a joined one alone */
}

static void send_field(fg__wire *wire, fg_field *field)
{
  field_facts facts = {.arrays = field->contents,
                       .missing = field->missing,
                       .infinite = field->infinite,
                       .normal_share = field->normal_share};
  if (field->slab)
    facts.slab = *field->slab;
  pass_facts(wire, &facts);
  for (int k = 0; k < facts.arrays.dimension; ++k) {
    fg__wire_bytes(wire, field->velocity[k], fg__field_held(field) * sizeof(float));
    free(field->velocity[k]); /* the other process has it now: never both of all */
    field->velocity[k] = NULL;
  }
}

/* Notes in a field what its samples do not tell. */
static fg_status note_facts(fg_field *field, fg_context *context,
                            const field_facts *facts)
{
  field->missing = facts->missing;
  field->infinite = facts->infinite;
  field->normal_share = facts->normal_share;
  if (!field->slab)
    return FG_STATUS_OK;
  *field->slab = facts->slab;
  field->slab->input = fg__copy_text(facts->slab.input);
  return field->slab->input || !facts->slab.input
             ? FG_STATUS_OK
             : fg__fail_memory(context, "a name", strlen(facts->slab.input));
}

static void receive_field(fg__wire *wire, fg_field **out)
{
  field_facts facts = {.infinite = 0};
  float *velocity[3] = {NULL, NULL, NULL};
  pass_facts(wire, &facts);
  if (!is_good(wire))
    return;
  fg_field_arrays *arrays = &facts.arrays;
  const int last = arrays->dimension - 1;
  fg__slab_index slab = {facts.slab.number, facts.slab.count ? facts.slab.count : 1};
  size_t samples =
      (size_t)fg__rows_of(&slab, arrays->size[last], arrays->period[last] > 0.0).held;
  for (int k = 0; k < last; ++k)
    samples *= (size_t)arrays->size[k];
  arrays->valid = NULL;
  for (int k = 0; k <= last && is_good(wire); ++k) {
    arrays->velocity[k] = velocity[k] = fg__allocate(samples, sizeof(float));
    if (velocity[k])
      fg__wire_bytes(wire, velocity[k], samples * sizeof(float));
    else
      wire->status =
          fg__fail_memory(wire->context, "the velocity", samples * sizeof(float));
  }
  if (is_good(wire))
    wire->status = fg__field_of_rows(out, wire->context, arrays, velocity, &slab);
  if (is_good(wire))
    wire->status = note_facts(*out, wire->context, &facts);
  for (int k = 0; k < 3; ++k)
    free(velocity[k]);
}

void fg__wire_field(fg__wire *wire, fg_field **field)
{
  if (wire->sends) {
    send_field(wire, *field);
    return;
  }
  *field = NULL;
  receive_field(wire, field);
  if (!is_good(wire)) {
    fg_field_destroy(*field);
    *field = NULL;
  }
}

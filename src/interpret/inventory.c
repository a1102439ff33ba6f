#include "interpret/inventory.h"
#include "base/memory.h"
#include "base/utf8.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct value_list {
  fg_axis_value *value; /* NULL: none */
  char *text;
} value_list;

typedef struct entry {
  fg_inventory_vector vector;
  char *text[FG__VECTOR_TEXTS];
  value_list time, level;
} entry;

struct fg_inventory {
  char *format;
  entry *entries;
  size_t count;
  size_t capacity;
};

void fg__set_unusable(char reason[FG__REASON_BYTES], const char *format, ...)
{
  if (reason[0])
    return;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(reason, FG__REASON_BYTES, format, arguments);
  va_end(arguments);
}

void fg__doubt(char doubts[FG__REASON_BYTES], const char *format, ...)
{
  const size_t used = strlen(doubts);
  va_list arguments;
  va_start(arguments, format);
  if (used + 2 < FG__REASON_BYTES) {
    const size_t start = used > 0 ? used + 1 : 0;
    if (used > 0)
      memcpy(doubts + used, "\n", 2);
    vsnprintf(doubts + start, FG__REASON_BYTES - start, format, arguments);
  }
  va_end(arguments);
}

fg_status fg__inventory_create(fg_inventory **out, fg_context *context,
                               const char *format)
{
  fg_inventory *inventory = fg__allocate(1, sizeof *inventory);
  if (inventory)
    inventory->format = fg__copy_text(format);
  if (!inventory || !inventory->format) {
    fg_inventory_destroy(inventory);
    return fg__fail_memory(context, "an inventory", sizeof *inventory);
  }
  *out = inventory;
  return FG_STATUS_OK;
}

/* Copies a text to `next`; returns where the one after it goes. */
static char *copy_word(const char **out, char *next, const char *text)
{
  const size_t length = strlen(text);
  fg__utf8_take(next, 2 * length + 1, text, length);
  *out = next;
  return next + strlen(next) + 1;
}

/* Copies values with their texts, all in one allocation; NULL gives NULL. False: no
 * memory. */
static bool copy_values(value_list *out, const fg_axis_value *values, int count)
{
  if (!values || count < 1)
    return true;
  size_t bytes = 0;
  for (int n = 0; n < count; ++n)
    bytes += 2 * (strlen(values[n].units) + strlen(values[n].words) + 1);
  out->value = fg__allocate((size_t)count, sizeof *out->value);
  out->text = fg__allocate(bytes, 1);
  if (!out->value || !out->text)
    return false;
  char *next = out->text;
  for (int n = 0; n < count; ++n) {
    out->value[n].value = values[n].value;
    next = copy_word(&out->value[n].units, next, values[n].units);
    next = copy_word(&out->value[n].words, next, values[n].words);
  }
  return true;
}

static void clear_entry(entry *e)
{
  free(e->time.value);
  free(e->time.text);
  free(e->level.value);
  free(e->level.text);
  for (int n = 0; n < FG__VECTOR_TEXTS; ++n)
    free(e->text[n]);
}

const char **fg__vector_text(fg_inventory_vector *vector, int n)
{
  const char **const place[FG__VECTOR_TEXTS] = {
      &vector->units,        &vector->found_by,    &vector->name[0],
      &vector->name[1],      &vector->name[2],     &vector->unusable,
      &vector->frame,        &vector->plane,       &vector->absent,
      &vector->chosen,       &vector->doubts,      &vector->axis_name[0],
      &vector->axis_name[1], &vector->axis_name[2]};
  return place[n];
}

/* Copies the texts, of which units and found_by are always there. */
static bool copy_texts(entry *e)
{
  enum { ALWAYS_THERE = 2 };
  bool copied = true;
  for (int n = 0; n < FG__VECTOR_TEXTS; ++n) {
    const char **place = fg__vector_text(&e->vector, n);
    if (!*place && n < ALWAYS_THERE)
      *place = "";
    e->text[n] = fg__utf8_copy(*place);
    copied = copied && (e->text[n] || !*place);
    *place = e->text[n];
  }
  return copied;
}

fg_status fg__inventory_add(fg_inventory *inventory, fg_context *context,
                            const fg_inventory_vector *vector)
{
  entry e = {.vector = *vector};
  const bool copied = copy_texts(&e) &&
                      copy_values(&e.time, vector->time_value, vector->times) &&
                      copy_values(&e.level, vector->level_value, vector->levels);
  e.vector.time_value = e.time.value;
  e.vector.level_value = e.level.value;
  void *entries = inventory->entries;
  if (!copied ||
      !fg__grow(&entries, &inventory->capacity, inventory->count + 1, sizeof e)) {
    clear_entry(&e);
    return fg__fail_memory(context, "an inventory's entry", sizeof e);
  }
  inventory->entries = entries;
  inventory->entries[inventory->count++] = e;
  return FG_STATUS_OK;
}

void fg_inventory_destroy(fg_inventory *inventory)
{
  if (!inventory)
    return;
  for (size_t i = 0; i < inventory->count; ++i)
    clear_entry(&inventory->entries[i]);
  free(inventory->entries);
  free(inventory->format);
  free(inventory);
}

const char *fg_inventory_format(const fg_inventory *inventory)
{
  return inventory ? inventory->format : "";
}

int fg_inventory_vector_count(const fg_inventory *inventory)
{
  return inventory ? (int)inventory->count : 0;
}

const fg_inventory_vector *fg_inventory_vector_at(const fg_inventory *inventory,
                                                  int index)
{
  if (!inventory || index < 0 || (size_t)index >= inventory->count)
    return NULL;
  return &inventory->entries[index].vector;
}

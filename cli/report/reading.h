/* What is read, and what came of it: the same in run.json and for `info`. */
#ifndef REPORT_READING_H
#define REPORT_READING_H

#include "option/settings.h"
#include "report/json.h"

typedef struct reading_facts {
  const reading_settings *settings;
  const fg_field *field;
  int times, levels; /* of the input; 0: unknown */
  char found_by[256], frame[512];
} reading_facts;

/* Finds what an input says of its vector: times, levels, and the rules by which it was
 * found. */
void reading_find(reading_facts *facts, fg_input *input);

/* Adds the objects "input" and "field". */
void reading_report(cJSON *root, const reading_facts *facts);

#endif

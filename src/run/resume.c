/* The record of a run for a checkpoint; not in the core, which has no files. */
#include "base/context.h"
#include "run/run.h"

void fg_run_describe(fg_run_record *out, const fg_run *run)
{
  const fg_run *s = run;
  *out = (fg_run_record){.count = s->plan.count,
                         .next = s->plan.next,
                         .taken = s->taken,
                         .last_clusters = s->last_clusters,
                         .last_step = s->last_step,
                         .first = s->first};
  for (int k = 0; k < s->plan.count; ++k)
    out->wanted[k] = s->plan.wanted[k];
}

fg_status fg_run_resume(fg_step *step, fg_run *run, const fg_checkpoint *checkpoint,
                        const fg_run_record *record)
{
  fg_run *s = run;
  if (record->count < 0 || record->count > FG_MOST_SCALES || record->next < 0 ||
      record->next > record->count)
    return fg__fail(s->context, FG_STATUS_ARGUMENT,
                    "scales: a record of %d numbers, %d of them reached", record->count,
                    record->next);
  fg_status status = fg_evolution_resume(s->evolution, &s->step, checkpoint);
  if (status)
    return status;
  for (int k = 0; k < record->count; ++k)
    s->plan.wanted[k] = record->wanted[k];
  s->plan.count = record->count;
  s->plan.next = record->next;
  s->taken = record->taken;
  s->last_clusters = record->last_clusters;
  s->last_step = record->last_step;
  s->first = record->first;
  s->outcome = fg__run_ending(s);
  *step = s->step;
  return FG_STATUS_OK;
}

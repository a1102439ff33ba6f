#include "option/table.h"

#include "option/families.h"

const option_family *const option_families[] = {
    &output_options,  &input_options,   &method_options,
    &picture_options, &general_options, NULL,
};

const option_entry *option_at(size_t index)
{
  for (size_t k = 0; option_families[k]; ++k) {
    if (index < option_families[k]->count)
      return &option_families[k]->option[index];
    index -= option_families[k]->count;
  }
  return NULL;
}

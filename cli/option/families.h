/* Tables of options: input_options.c, method_options.c, picture_options.c and
 * work_options.c. */
#ifndef OPTION_FAMILIES_H
#define OPTION_FAMILIES_H

#include "option/table.h"

/* Location of an option's value: in a command's own settings, or in a shared group. */
#define OWN(command, member) GROUP_OWN, offsetof(command##_settings, member)
#define READING(member) GROUP_READING, offsetof(reading_settings, member)
#define EVOLUTION(member) GROUP_EVOLUTION, offsetof(evolution_settings, member)
#define WORK(member) GROUP_WORK, offsetof(work_settings, member)
#define PICTURE(member) GROUP_PICTURE, offsetof(picture_settings, member)
#define INPUT(member) GROUP_INPUTS, offsetof(input_settings, member)
#define NOWHERE GROUP_OWN, 0

extern const option_family output_options, input_options, method_options, picture_options,
    general_options;

#endif

/* The tables of commands (commands.c) and options (…_options.c), from which parsing,
 * --help and the manual page are made. */
#ifndef OPTION_TABLE_H
#define OPTION_TABLE_H

#include <stdio.h>

#include "option/settings.h"

enum {
  COMMAND_RUN = 1,
  COMMAND_DRAW = 2,
  COMMAND_INFO = 4,
  COMMAND_SYNTH = 8,
  COMMAND_RIVAL = 16,
  COMMAND_TEXTURE = 32,
  COMMAND_BRUSH = 64,
  COMMAND_GALLERY = 128,
  COMMAND_SCORE = 256,
  COMMAND_VIEW = 512,

  EVERY = 2 * COMMAND_VIEW - 1,
  RUNS = COMMAND_RUN | COMMAND_VIEW, /* have run_settings */
  READERS = RUNS | COMMAND_INFO | COMMAND_RIVAL | COMMAND_TEXTURE |
            COMMAND_SCORE,         /* have reading_settings */
  INPUTS = READERS | COMMAND_DRAW, /* have input_settings */
  SEEDED = RUNS | COMMAND_TEXTURE | COMMAND_BRUSH,
  PICTURES = RUNS | COMMAND_DRAW | COMMAND_RIVAL /* have picture_settings */
};

/* The struct with an option's value: the command's own, or one of its groups. */
typedef enum option_group {
  GROUP_OWN = 0,
  GROUP_READING,
  GROUP_INPUTS,
  GROUP_EVOLUTION,
  GROUP_WORK,
  GROUP_PICTURE,
  GROUPS
} option_group;

typedef struct cli_command {
  unsigned bit;
  const char *name;
  const char *operand;  /* name of the first operand; NULL: none */
  const char *more;     /* name of further operands; NULL: none */
  bool needs_more;      /* at least one further operand is required */
  const char *synopsis; /* text after the command's name */
  const char *summary;  /* a clause, for the list of commands */
  const char *text;     /* a paragraph, for the command's help */
  int (*work)(const void *settings);
  /* Offsets in the settings: of its groups, its operands, and of -o if it is required
   * (never at 0, which means not required). */
  size_t group[GROUPS], operand_place, more_place, output_place;
  size_t most_numbers; /* maximum length of a list of arrows or clusters */
} cli_command;

typedef enum option_kind {
  OPTION_TEXT,    /* const char * */
  OPTION_WHOLE,   /* int, least to most */
  OPTION_SEED,    /* uint64_t */
  OPTION_NUMBER,  /* double, least to most; the ends as `open` says */
  OPTION_FLAG,    /* bool */
  OPTION_CHOICE,  /* int: the value for the word's index in `words` */
  OPTION_NUMBERS, /* number_list */
  OPTION_TIMES,   /* time_list */
  OPTION_FORMATS, /* unsigned: bits */
  OPTION_PALETTE, /* const char *: a palette's name or #rrggbb */
  OPTION_PLACES,  /* const char *: a time or a level, or several for run */
  OPTION_CENTER,  /* in fg_map_options: one or two numbers */
  OPTION_REGION,  /* in fg_map_options: four numbers */
  OPTION_WORDS,   /* const char *: a text, which may be empty */
  OPTION_COLOR,   /* const char *: #rrggbb */
  OPTION_LENGTH,  /* double: points, least to most; typed in pt, mm, cm or in */
  OPTION_RANGE,   /* double[2]: two ascending numbers */
  OPTION_VIEW,    /* adds a view to picture_settings */
  OPTION_HELP,
  OPTION_VERSION
} option_kind;

typedef struct option_entry {
  const char *name;
  char letter;          /* 0: none */
  const char *argument; /* NULL: takes none */
  unsigned commands;    /* bits of the commands with this option */
  option_kind kind;
  option_group group;
  size_t place; /* offset in the group */
  double least, most;
  bool open_below, open_above; /* whether least, most themselves are excluded */
  bool once;                   /* a second text does not replace the first */
  const char *const *words;    /* terminated by NULL */
  const char *help;            /* a clause, with the default in [brackets] */
} option_entry;

extern const cli_command command_table[];
extern const size_t command_count;
/* Options under one heading of --help. */
typedef struct option_family {
  const char *heading;
  const option_entry *option;
  size_t count;
} option_family;

/* In the order of --help, terminated by NULL. */
extern const option_family *const option_families[];

/* The option of this index over all families; NULL after the last. */
const option_entry *option_at(size_t index);

/* Offset of an option's value in a command's settings. */
size_t option_place(const cli_command *command, const option_entry *option);

/* Names of the picture formats, in the order of their bits. */
extern const char *const format_words[FORMAT_KINDS];

/* Words of options in the order of their enumerations (fg_scale, fg_mesh_kind, fg_scheme,
 * fg_energy), terminated by NULL; and the index of an energy's word, -1 for a file. */
extern const char *const energy_words[],
    *const mesh_words[], *const scale_words[], *const frame_words[],
                                                   *const scheme_words[],
                                                       *const effort_words[],
                                                           *const extent_words[];
int energy_place(const char *word);

/* Whether --help and the manual list an option for a command: all of its options, except
 * those that view passes on to run. */
bool option_is_documented(const cli_command *command, const option_entry *option);

/* The command of this name; NULL: none. */
const cli_command *command_find(const char *name);

void print_program_help(FILE *stream);
void print_command_help(FILE *stream, const cli_command *command);

#endif

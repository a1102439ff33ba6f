/* Linked to sanitized programs, so that the leak check tells MPI's leaks from ours.
 *
 * What MPI has loaded stays loaded to the end: a stack then names its modules, and
 * scripts/lsan.supp goes by these. What MPI allocates where it starts and ends does not
 * count as a leak. Without that each allocation would have to record its whole stack, for
 * MPI is compiled without frame pointers; programs would take twice as long. */
#include <sanitizer/lsan_interface.h>

#pragma GCC visibility push(default)
int dlclose(void *handle);
int MPI_Init_thread(int *count, char ***arguments, int wanted, int *provided);
int MPI_Finalize(void);
#pragma GCC visibility pop

/* MPI's own names of the same, absent from programs without MPI */
__attribute__((weak)) int PMPI_Init_thread(int *, char ***, int, int *);
__attribute__((weak)) int PMPI_Finalize(void);

int dlclose(void *handle)
{
  (void)handle;
  return 0;
}

int MPI_Init_thread(int *count, char ***arguments, int wanted, int *provided)
{
  __lsan_disable();
  const int status = PMPI_Init_thread(count, arguments, wanted, provided);
  __lsan_enable();
  return status;
}

int MPI_Finalize(void)
{
  __lsan_disable();
  const int status = PMPI_Finalize();
  __lsan_enable();
  return status;
}

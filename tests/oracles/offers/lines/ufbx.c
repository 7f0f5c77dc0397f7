/* The lines for ufbx, which is C99. */
#include <math.h>
#include <stdio.h>

/* lines 0 */
int main(void) {
  const double n = 96.08, f0 = phong_f0(n, 0.5), f = f0;
  /* lines 1 */
  printf("%.3f %.4f %.2f\n", phong_roughness(n), f0 * tint, ior);
  return blinn_roughness(0.5) == 1.0 && blinn_f0(0.5, 1.0) == 0.0 ? 0 : 1;
}

/* Every value of the table is the integral. PRINT=1 prints core/shade/lights/dfg.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "shade/lights/dfg.h"
#include "unit/common/split_sum_integral.h"

static double cosine_of(int column)
{
    const double share = (double)column / (ZR_DFG_SIDE - 1);
    return share * share;
}

static void print_table(void)
{
    printf("#include \"shade/lights/dfg.h\"\n\n/* clang-format off */\n"
           "const float zr_dfg_table[ZR_DFG_SIDE][2][ZR_DFG_SIDE] = {\n");
    for (int row = 0; row < ZR_DFG_SIDE; row++) {
        printf("    {");
        for (int which = 0; which < 2; which++) {
            printf("%s{", which ? ",\n     " : "");
            for (int column = 0; column < ZR_DFG_SIDE; column++) {
                double ab[2];
                integrate_split_sum((double)row / (ZR_DFG_SIDE - 1), cosine_of(column), 1024, &ab[0], &ab[1]);
                printf("%.6ff%s", ab[which], column + 1 < ZR_DFG_SIDE ? (column % 8 == 7 ? ",\n      " : ", ") : "");
            }
            printf("}");
        }
        printf("}%s\n", row + 1 < ZR_DFG_SIDE ? "," : "");
    }
    printf("};\n/* clang-format on */\n");
}

static void values_are_integrals(void **state)
{
    double worst = 0.0;
    (void)state;
    for (int row = 0; row < ZR_DFG_SIDE; row++)
        for (int column = 0; column < ZR_DFG_SIDE; column++) {
            double a, b;
            integrate_split_sum((double)row / (ZR_DFG_SIDE - 1), cosine_of(column), 160, &a, &b);
            worst = fmax(worst, fabs((double)zr_dfg_table[row][0][column] - a));
            worst = fmax(worst, fabs((double)zr_dfg_table[row][1][column] - b));
        }
    print_message("worst difference: %.5f\n", worst);
    assert_true(worst < 0.004);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_integrals),
    };
    if (getenv("PRINT")) {
        print_table();
        return 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* line_rule.h - reference: by which rules the Mesa at hand draws lines, points and fog.
 *
 * Lines, points and fog changed between Mesa 22.3 and 25.0 (RULES.md, rules 12, 21, 28). The renderer draws as 25.0
 * does. With an older Mesa only a build that has mutants (base/mutant.h) can be compared: it chooses the older rules.
 */
#ifndef ZR_TEST_LINE_RULE_H
#define ZR_TEST_LINE_RULE_H

#include "reference/gl/reference.h"

/* Older: up to 22.3. Current: from 25.0 on. */
enum line_rule { LINE_RULE_OLDER, LINE_RULE_CURRENT };

/* The name that --line-rule prints. */
extern const char *const line_rule_names[];

/* Found by drawing two lines that the rules differ about; false where these follow neither rule, or another one than
 * the version that Mesa tells has. For llvmpipe. */
bool line_rule_find(struct reference *reference, enum line_rule *rule, struct reference_error *error);

/* Makes our side draw by this rule. False where this build cannot. */
bool line_rule_choose(enum line_rule rule);

#endif

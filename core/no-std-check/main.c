/* Calls the static library for a pair that touches, a pair that does not, and two triangles apart. */
#include <stddef.h>
#include <stdint.h>

uint32_t verdicts_f64(const double points[4][2][3]);
uint32_t verdicts_f32(const float points[4][2][3]);
uint32_t near(const float points[4][2][3]);
uint32_t separations(const double points[4][2][3]);
double height(const double points[4][2][3]);
size_t distributed(const uint32_t corners[2][3], uint8_t vertices, uint8_t edges);

#define FACE {{0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}

int main(void) {
    /* A vertex falls through a triangle: as vertex and face nothing is culled and the contact is found. */
    const double through[4][2][3] = {{{0.2, 0.2, 1}, {0.2, 0.2, -1}}, FACE};
    const float through_f32[4][2][3] = {{{0.2f, 0.2f, 1}, {0.2f, 0.2f, -1}}, FACE};
    /* It stays above: all six answers are that they do not touch. So are the exact ones in bits 10 to 12, and every tier's (bit
       13; bit 14 would say that they disagree). */
    const double above[4][2][3] = {{{0.2, 0.2, 2}, {0.2, 0.2, 1}}, FACE};
    const float above_f32[4][2][3] = {{{0.2f, 0.2f, 2}, {0.2f, 0.2f, 1}}, FACE};
    const uint32_t apart[2][3] = {{0, 1, 2}, {3, 4, 5}};

    if ((verdicts_f64(through) & 0xffff) != 0) return 1;
    if ((verdicts_f32(through_f32) & 0xffff) != 0) return 2;
    if ((verdicts_f64(above) & 0xffff) != 0x3db3) return 3;
    if ((verdicts_f32(above_f32) & 0xffff) != 0x3db3) return 4;
    if (distributed(apart, 3, 3) != 15) return 5;
    if (near(through_f32) != 0x28) return 7;
    if (near(above_f32) != 0x08) return 8;
    /* Through: above at the start, not at the end. Above: all but near the face. */
    if (separations(through) != 0x22) return 9;
    if (separations(above) != 0x3f) return 10;
    /* In the middle of the step they meet, or it is half as high again as the face is long. */
    if (height(through) != 0) return 11;
    if (height(above) != 1.5) return 12;
    if (distributed(apart, 4, 3) != 0) return 6;
    return 0;
}

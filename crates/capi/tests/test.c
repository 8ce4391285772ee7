/* The C interface from C: compiled as C99 and as C++, run on the host; the same file is the test on a chip. */
#include "fsample.h"

#ifdef HOSTED
#include <stdio.h>
#define CHECK(holds)                                                  \
    do {                                                              \
        if (!(holds)) {                                               \
            printf("%s:%d: %s\n", __FILE__, __LINE__, #holds);        \
            return 1;                                                 \
        }                                                             \
    } while (0)
#else
#define CHECK(holds)             \
    do {                         \
        if (!(holds)) {          \
            return __LINE__;     \
        }                        \
    } while (0)
#endif

static uint64_t flattener[FSAMPLE_FLATTENER_BYTES / 8];
static uint64_t planner[FSAMPLE_PLANNER_BYTES / 8];
static uint64_t memory[FSAMPLE_JOB_BYTES / 8];

/* A job: options, a path of one cubic with 33 places and eight arcs, and the end with its checksum. It is built here, so that the test needs no file. */
static uint8_t job[160];
static uint32_t length, sum, next_byte, samples, motors, downs, calls_between;
static int32_t at_x, at_y;

static void put(uint8_t byte)
{
    int bit;
    job[length++] = byte;
    sum ^= byte;
    for (bit = 0; bit < 8; bit++) {
        sum = (sum & 1) ? (sum >> 1) ^ 0xEDB88320u : sum >> 1;
    }
}

static void put_word(uint32_t word)
{
    int k;
    for (k = 0; k < 4; k++) {
        put((uint8_t)(word >> (8 * k)));
    }
}

static void put_float(float v)
{
    union {
        float f;
        uint32_t u;
    } both;
    both.f = v;
    put_word(both.u);
}

static void make_job(void)
{
    static const float options[9] = {0.5f, 0.05f, 0.05f, 0.1f, 0.0f, 50.0f, 5.0f, 1000.0f, 80.0f};
    static const float cubic[6] = {0.0f, 20.0f, 30.0f, -10.0f, 30.0f, 10.0f};
    int k;
    length = 0;
    sum = 0xFFFFFFFFu;
    put('F');
    put('S');
    put('J');
    put('1');
    put(1);
    for (k = 0; k < 9; k++) {
        put_float(options[k]);
    }
    put(32);
    put(0);
    put(2);
    put_float(0.0f);
    put_float(0.0f);
    put(0);
    put(3);
    for (k = 0; k < 6; k++) {
        put_float(cubic[k]);
    }
    put(7);
    put(33);
    put(0);
    put(0);
    for (k = 1; k < 8; k++) {
        put(8);
        put_float((float)k / 8.0f);
    }
    put(15);
    put_word(~sum);
}

static int32_t byte(void *user)
{
    (void)user;
    return next_byte < length ? job[next_byte++] : -1;
}

static void between(void *user)
{
    (void)user;
    calls_between++;
}

static void sample(void *user, float x, float y, float lfs)
{
    (void)user;
    (void)x;
    (void)y;
    samples += lfs > 0.0f;
}

static void pen(void *user, int32_t down)
{
    (void)user;
    downs += down != 0;
}

static void motor(void *user, const fsample_step *step)
{
    (void)user;
    motors += step->after > 0;
    at_x += step->x;
    at_y += step->y;
}

int test(void)
{
    static const float cubic[8] = {0.0f, 0.0f, 0.0f, 20.0f, 30.0f, -10.0f, 30.0f, 10.0f};
    static const fsample_limits limits = {50.0f, 5.0f, 1000.0f, 80.0f, 84e6f};
    static const fsample_calls calls = {0, byte, between, sample, pen, motor};
    static const fsample_calls none = {0, 0, 0, 0, 0, 0};
    float point[2] = {0.0f, 0.0f};
    fsample_step step;
    int32_t count, x = 0;

    CHECK(fsample_bytes(FSAMPLE_FLATTENER) > 0 && fsample_bytes(FSAMPLE_FLATTENER) <= sizeof flattener);
    CHECK(fsample_bytes(FSAMPLE_PLANNER) > 0 && fsample_bytes(FSAMPLE_PLANNER) <= sizeof planner);
    CHECK(fsample_bytes(FSAMPLE_JOB) > 0 && fsample_bytes(FSAMPLE_JOB) <= sizeof memory);
    CHECK(fsample_bytes(99) == 0);

    CHECK(fsample_flatten_begin(0, cubic, 0.1f) == FSAMPLE_BAD_POINTER);
    CHECK(fsample_flatten_begin(flattener, cubic, -1.0f) == FSAMPLE_BAD_NUMBER);
    CHECK(fsample_flatten_begin(flattener, cubic, 0.1f) == 0);
    for (count = 0; fsample_flatten_next(flattener, point) == 1; count++) {
        CHECK(count < 1000);
    }
    CHECK(count > 4 && point[0] == 30.0f && point[1] == 10.0f);

    CHECK(fsample_planner_begin(planner, &limits) == 0);
    CHECK(fsample_planner_line(planner, 2.0f, -1.0f) == 0);
    CHECK(fsample_planner_step(planner, &step) == 0);
    CHECK(fsample_planner_flush(planner) == 0);
    for (count = 0; fsample_planner_step(planner, &step) == 1; count++) {
        CHECK(count < 1000 && step.after > 0 && step.x == 1 && step.y <= 0);
        x += step.x;
    }
    CHECK(count == 160 && x == 160);
    CHECK(fsample_planner_line(planner, 1e9f, 0.0f) == FSAMPLE_BAD_NUMBER);
    for (count = 0; fsample_planner_line(planner, (float)count, 0.0f) == 0; count++) {
        CHECK(count < 100);
    }
    CHECK(fsample_planner_line(planner, 0.0f, 0.0f) == FSAMPLE_FULL);

    make_job();
    next_byte = samples = motors = downs = calls_between = 0;
    at_x = at_y = 0;
    count = fsample_job(memory, &calls, 8);
    CHECK(count > 10 && (uint32_t)count == samples);
    CHECK(downs == 1 && motors > 2400 && calls_between > motors);
    CHECK(at_x == 2400 && at_y == 800);

    /* Damaged, truncated and missing: a fault each, and the good job still runs. */
    job[60] ^= 1;
    next_byte = 0;
    CHECK(fsample_job(memory, &calls, 8) == -0x105);
    job[60] ^= 1;
    length -= 2;
    next_byte = 0;
    CHECK(fsample_job(memory, &calls, 8) == -0x107);
    CHECK(fsample_job(memory, &none, 8) == -0x107);
    CHECK(fsample_job(memory, 0, 8) == FSAMPLE_BAD_POINTER);
    make_job();
    next_byte = 0;
    samples = 0;
    CHECK(fsample_job(memory, &calls, 8) == (int32_t)samples && samples > 10);
    return 0;
}

#ifdef HOSTED
int main(void)
{
    return test();
}
#endif

/* Feature-size sampling for firmware in C and C++.
 *
 * Nothing is allocated: each object lives in memory that the caller lends, aligned to 8 bytes and of the size that the
 * macro beside it names (the same on every target: `fsample_bytes` says how much of it is used). An object must not be moved
 * once it has begun. Lengths are in user units. No function may be called from two contexts at once for the same object. */
#ifndef FSAMPLE_H
#define FSAMPLE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Answers below zero. A job's faults are -0x100 and below: see fsample_job. */
#define FSAMPLE_BAD_POINTER (-1)
#define FSAMPLE_BAD_NUMBER (-2)
#define FSAMPLE_FULL (-3)

/* Sizes of the objects, and what to ask fsample_bytes for. */
#define FSAMPLE_FLATTENER 0
#define FSAMPLE_FLATTENER_BYTES 64
#define FSAMPLE_PLANNER 1
#define FSAMPLE_PLANNER_BYTES 512
#define FSAMPLE_JOB 2
#define FSAMPLE_JOB_BYTES 58368

/* How many bytes of an object are used; 0 for what there is not. */
uint32_t fsample_bytes(int32_t what);

/* Tier 0. Begins to flatten a cubic, given by its control points x0, y0, ... x3, y3, within a chord error above 0.
 * Answers 0, FSAMPLE_BAD_POINTER, or FSAMPLE_BAD_NUMBER. */
int32_t fsample_flatten_begin(void *flattener, const float *cubic, float tolerance);

/* The next point of the polygon, after the cubic's start, into point[0] and point[1]: answers 1; 0 after its end. One
 * evaluation of the cubic and one square root a call. */
int32_t fsample_flatten_next(void *flattener, float *point);

/* Limits of a machine: user units and seconds; ticks a second of the timer that times the steps. */
typedef struct {
    float feed;
    float corner_speed;
    float acceleration;
    float steps_per_unit;
    float clock;
} fsample_limits;

/* One step of the motors: ticks since the one before; x and y are -1, 0 or 1. */
typedef struct {
    uint32_t after;
    int8_t x;
    int8_t y;
} fsample_step;

/* A planner at rest at the origin. Answers 0, FSAMPLE_BAD_POINTER, or FSAMPLE_BAD_NUMBER. */
int32_t fsample_planner_begin(void *planner, const fsample_limits *limits);

/* Adds a straight line. Answers 0, FSAMPLE_FULL (take steps first), or FSAMPLE_BAD_NUMBER. */
int32_t fsample_planner_line(void *planner, float x, float y);

/* What was added is run until the pen rests. Answers 0. */
int32_t fsample_planner_flush(void *planner);

/* The next step: answers 1; 0 where the pen rests or more lines should be added first. */
int32_t fsample_planner_step(void *planner, fsample_step *step);

/* Tier 2: what a job calls. Any function may be null; each gets `user`. `byte` answers the next byte of the job's stream, or
 * a negative number where there is none. `between` is called after every piece of work: a foot point, a bounded call of the
 * sampler, a motor step. */
typedef struct {
    void *user;
    int32_t (*byte)(void *user);
    void (*between)(void *user);
    void (*sample)(void *user, float x, float y, float lfs);
    void (*pen)(void *user, int32_t down);
    void (*motor)(void *user, const fsample_step *step);
} fsample_calls;

/* Receives a job (the .fsj format) and draws it; `budget` is the number of turns of a call of the sampler, 8 say. Answers
 * the number of samples, FSAMPLE_BAD_POINTER, or minus the fault: 0x101 to 0x109 the stream is no job (1 magic, 2 unknown
 * command, 3 range, 4 order, 5 checksum, 7 truncated), 0x200 too little memory, 0x301 and 0x302 no curve, 0x400 sampling,
 * 0x500 motion. The memory is free for the next job afterwards, whatever the answer. */
int32_t fsample_job(void *memory, const fsample_calls *calls, uint32_t budget);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: BSD-3-Clause
 *
 * ents - enriched node-to-segment contact elements for finite element codes.
 *
 * The master surface of an element is rho_e(xi) = rho(xi) + h(xi) n(xi): the segment rho interpolated
 * from the host's nodes, displaced by a height function h along its unit normal n. The library returns
 * the projection of a slave node on rho_e, its variations, and the residual and consistent tangent of the contact element.
 *   V. Yastrebov, G. Cailletaud, F. Feyel, Enrichment of the contact geometry within the finite
 *   element method, CSMA 2011, hal-00592720 ("the paper"; eq. numbers below are its own).
 *
 * Conventions
 *   - indices are 0-based; every position is a CURRENT position (reference + displacement);
 *   - dofs are node-major: slave node first, then the master nodes of the segment (slave alone when the
 *     model says "master": "rigid"); matrices are column-major;
 *   - gap > 0 open, gap < 0 penetration; the master normal is the tangent turned by +90 degrees in 2D and
 *     rho_,1 x rho_,2 in 3D;
 *   - residual R = dW/du is the internal force on the host's nodes, tangent K = dR/du;
 *   - units are the host's. [L] length, [F] force, [A] tributary area (2D: length times thickness).
 *
 * Segments: order of the master nodes, counted from 0, and natural coordinates xi. "line": -1 .. 1; "square": -1 .. 1 in both;
 * "triangle": xi_1 >= 0, xi_2 >= 0, xi_1 + xi_2 <= 1
 *   line2                     line      ends, at xi = -1, 1
 *   line3                     line      ends, then the middle
 *   tri3                      triangle  corners, at (0,0) (1,0) (0,1)
 *   tri6                      triangle  corners as tri3, then the middles of the sides 01, 12, 20
 *   quad4                     square    corners, at (-1,-1) (1,-1) (1,1) (-1,1)
 *   quad8, quad9              square    corners as quad4, then the middles of the sides 01, 12, 23, 30; quad9: then the centre
 *   catmull_rom4, bspline4    line      four points in a row. The segment lies between the middle two: catmull_rom4 begins in point 1
 *                                       and ends in 2, bspline4 at (x_0 + 4 x_1 + x_2) / 6 and (x_1 + 4 x_2 + x_3) / 6
 *   catmull_rom16, bspline16  square    four rows of four: point 4 j + i, i grows with xi_1, j with xi_2. The segment lies between the
 *                                       middle four: the corners of catmull_rom16 are points 5, 6, 10, 9, in the order of quad4
 *   bezier15                  triangle  control points: corners as tri3, then three on each of the sides 01, 12, 20, in its direction,
 *                                       then the three inner ones, each next to its corner
 * The normal has to point out of the master's body, to the slave nodes. 2D: it is on the left of the direction from the first end of
 * the line to the other (towards +y if that is +x). 3D: seen from its tip, the corners go round counter-clockwise (it is +z if they
 * do so in the plane of x and y). The library cannot detect a wrong order: a segment with the reversed normal takes open nodes for
 * penetrating ones and penetrating ones for open ones; one with its middles between the corners is another surface.
 *
 * Rules
 *   - a model is the only handle. It is immutable: any number of threads may evaluate it at once;
 *   - an evaluation is a pure function: the same inputs give the same bits, whatever the thread, the
 *     batch, or the calls before. It allocates nothing, prints nothing, throws nothing, takes no lock,
 *     and leaves the floating-point environment (rounding, traps, flags) as it found it;
 *   - a call needs up to 256 KiB of stack (100 KiB for one element of one segment; models are made with more): give the threads of a host
 *     as much (OpenMP: OMP_STACKSIZE);
 *   - every struct starts with `struct_size`: zero the struct, then set struct_size = sizeof(struct).
 *     A shorter (older) struct is served; a longer (newer) one is served if its unknown tail is zero;
 *   - every function returns a status, see ENTS_STATUS_TABLE. Messages go into the caller's report.
 */
#ifndef ENTS_H
#define ENTS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#if defined(ENTS_BUILD)
#define ENTS_API __declspec(dllexport)
#else
#define ENTS_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define ENTS_API __attribute__((visibility("default")))
#else
#define ENTS_API
#endif

/* What this header promises (the contract) and what implements it (the library) are numbered apart. A
 * library serves every header with the same contract major and an equal or smaller contract minor. */
#define ENTS_CONTRACT_MAJOR 1
#define ENTS_CONTRACT_MINOR 4

/* Status values; pinned, never renumbered.
 *   0            done
 *   1 .. 99      recoverable: nothing was written for that element except its status; cut the step
 *   -1 .. -99    the caller's mistake; the report says which argument or key
 *   -100 ..      installation or internal                                                               */
#define ENTS_STATUS_TABLE(X)                                                                       \
  X(ENTS_OK, 0, "ok")                                                                              \
  X(ENTS_NO_PROJECTION, 1, "the projection did not converge on this segment")                      \
  X(ENTS_SINGULAR_PROJECTION, 2, "singular projection: slave at a centre of curvature")            \
  X(ENTS_AMBIGUOUS_PROJECTION, 3, "ambiguous projection: two points are equally good")             \
  X(ENTS_DEGENERATE_SEGMENT, 4, "degenerate segment: zero area, folded, or no normal")             \
  X(ENTS_GRAZING_RAY, 5, "the shadow ray grazes the enriched surface")                             \
  X(ENTS_DEEP_PENETRATION, 6, "penetration exceeds the model's penetration_limit")                 \
  X(ENTS_OUT_OF_RANGE, 7, "a result exceeds the range of double precision")                        \
  X(ENTS_NULL_ARGUMENT, -1, "a required pointer is null")                                          \
  X(ENTS_STRUCT_SIZE, -2, "wrong struct_size or non-zero unknown tail")                            \
  X(ENTS_VERSION, -3, "the library does not serve this contract version")                          \
  X(ENTS_NON_FINITE, -4, "an input is NaN or infinite")                                            \
  X(ENTS_JSON_SYNTAX, -5, "the model text is not valid JSON")                                      \
  X(ENTS_UNKNOWN_KEY, -6, "unknown, duplicate or missing key in the model")                        \
  X(ENTS_BAD_VALUE, -7, "wrong type or value out of range")                           \
  X(ENTS_FILE, -8, "a file cannot be read or has the wrong format")                                \
  X(ENTS_BAD_MASK, -9, "unknown bit in `wanted`, or something the model cannot deliver")           \
  X(ENTS_BAD_COUNT, -10, "negative count, or a stride or leading dimension too small")             \
  X(ENTS_BAD_HANDLE, -11, "not a live model handle")                                               \
  X(ENTS_BAD_STATE, -12, "state block of another model, version, or not initialised")              \
  X(ENTS_BAD_PATTERN, -13, "the host's sparse matrix has no place for an entry")                   \
  X(ENTS_NO_MEMORY, -100, "out of memory")                                                         \
  X(ENTS_INTERNAL, -101, "internal error, please report it")

enum {
#define ENTS_STATUS_ENUM(name, value, text) name = value,
  ENTS_STATUS_TABLE(ENTS_STATUS_ENUM)
#undef ENTS_STATUS_ENUM
  ENTS_STATUS_LAST_ = -9999
};

/* Caller-owned message store; one per thread. Written by every function that gets one. */
typedef struct ents_report {
  int32_t struct_size;
  int32_t status;       /* status of the call */
  int64_t element;      /* first element concerned, -1 if none */
  double step_factor;   /* recoverable status: suggested factor in (0, 1) for the step; else 1 */
  char message[512];    /* zero-terminated; empty when the status is 0 */
} ents_report;

/* Text of a status value. Any thread, any time. Never null; an unknown value has a text, too. */
ENTS_API const char *ents_status_text(int32_t status);

/* Library version ("major.minor.patch", static text). */
ENTS_API const char *ents_version(void);

/* Does this library serve the caller's header? Call it once with the two macros above.
 * Returns 0 or ENTS_VERSION. */
ENTS_API int32_t ents_check_contract(int32_t major, int32_t minor, ents_report *report);

/* ---- model ------------------------------------------------------------------------------------ */

/* What the JSON text says, checked once, immutable afterwards. */
typedef struct ents_model ents_model;

/* Numbers a model may take from the caller's memory instead of a file or the text: a height map says
 * {"type": "map", "data": NAME, ...}. Copied by ents_model_create. */
typedef struct ents_data {
  int32_t struct_size;
  int32_t reserved;     /* 0 */
  const char *name;     /* zero-terminated */
  const double *values; /* [rows][columns], row by row; [L] for a height map */
  int64_t rows;         /* samples along s_2 (2D: 1) */
  int64_t columns;      /* samples along s_1 */
} ents_data;

/* Read a model from text (abi/model.schema.json says what it may hold).
 *   text, length     UTF-8; length in bytes, or -1 if zero-terminated
 *   directory        where relative file names of height maps start; null: the working directory
 *   data, data_count arrays the text refers to by name; null, 0 if none. The structs lie data[0].struct_size bytes apart
 *   model            out; null on failure
 * Errors: NULL_ARGUMENT, STRUCT_SIZE, JSON_SYNTAX (with byte offset), UNKNOWN_KEY and BAD_VALUE (with the
 * JSON path), FILE, NO_MEMORY. One thread per model under construction. */
ENTS_API int32_t ents_model_create(const char *text, int64_t length, const char *directory,
                                   const ents_data *data, int64_t data_count, ents_model **model,
                                   ents_report *report);

/* The same from a JSON file; relative names of height maps start at the file's own folder. */
ENTS_API int32_t ents_model_create_from_file(const char *path, ents_model **model, ents_report *report);

/* Release a model and set the handle to null. Null, or a handle that is null: no effect. No thread may be evaluating it. */
ENTS_API int32_t ents_model_destroy(ents_model **model, ents_report *report);

/* Sizes of everything a caller allocates for this model, in doubles where not said otherwise. */
typedef struct ents_layout {
  int32_t struct_size;
  int32_t dimension;           /* d: 2 or 3 */
  int32_t nodes;               /* m: master nodes of the segment; of the patch, if the model has one */
  int32_t parameters;          /* d-1: convective coordinates xi; also surface coordinates per master node */
  int32_t dofs;                /* d (m+1), or d for a rigid master; plus multipliers */
  int32_t state_size;          /* per element */
  int32_t symmetric_tangent;   /* 1 if K = K^T always */
  int32_t own_surface_coordinates; /* 1 if the model text carries them */
  int32_t multipliers;         /* dofs of multipliers, after those of the nodes: 0, 1, or d with friction */
  int32_t friction;            /* 1 if the law has friction */
  int32_t augmentable;         /* 1 if the multipliers live in the state: ents_state_augment */
  int32_t needs;               /* ENTS_NEEDS_... bits (since contract 1.3, as what follows; `reserved` before) */
  const char *instruction_set; /* of the kernels of its residuals and tangents: "portable", "avx2", "avx512". Static text. The
                                  bits of the results do not depend on it */
} ents_layout;

/* What the elements of a model need, decided when it is made. What it does not need is not computed. (A call does not compute what it does
 * not ask for, either, and an open element ends at its gap.) `ents-bench --savings` measures what each is worth. */
#define ENTS_NEEDS_HEIGHT      (1 << 0)  /* a height that is not zero everywhere; else the segments are plain ones, whatever the text says */
#define ENTS_NEEDS_SLOPE       (1 << 1)  /* a height of another type than "constant": it is evaluated with its derivatives at each step of a projection */
#define ENTS_NEEDS_CURVED      (1 << 2)  /* segments whose normal varies: all but line2 and tri3. It is followed through projection and variations */
#define ENTS_NEEDS_ITERATION   (1 << 3)  /* projections by Newton's method; else (plain line2, tri3) in closed form */
#define ENTS_NEEDS_MASTER      (1 << 4)  /* a master that deforms: R and K of its dofs, too; else ("master": "rigid") of the slave's alone */
#define ENTS_NEEDS_FRICTION    (1 << 5)  /* tangential forces and their limit; else K is symmetric and no anchor is kept */
#define ENTS_NEEDS_HISTORY     (1 << 6)  /* the force depends on ents_input.state_begin (friction, multipliers in the state); else on positions
                                            alone, and the state serves as start of the projection of a slave in contact */
#define ENTS_NEEDS_MULTIPLIERS (1 << 7)  /* dofs of multipliers after those of the nodes */
#define ENTS_NEEDS_ONE_BY_ONE  (1 << 8)  /* residual and tangent from the general kernel, element by element: the model has something that
                                            the kernels of ordinary elements, which take as many at once as a register holds, do not
                                            know (a shadow projection, a law other than penalty and power, a tangent other
                                            than the consistent one, "symmetrised", a patch ...) */

ENTS_API int32_t ents_model_layout(const ents_model *model, ents_layout *layout, ents_report *report);

/* ---- whole surfaces --------------------------------------------------------------------------- */

/* A master surface: many segments of the model's basis over one set of nodes. The arrays stay the caller's. */
typedef struct ents_master_mesh {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  int64_t segments;
  const int64_t *connectivity;       /* [segments][m], 0 <= index < nodes */
  int64_t nodes;
  const double *positions;           /* [nodes][d] current positions, [L], finite */
  const double *surface_coordinates; /* [segments][m][d-1] s of each segment's nodes (a seam has two values in one node);
                                        null: the model's own, else s = xi */
} ents_master_mesh;

/* Detection: which segment is a slave node projected on? A tree of boxes around the enriched segments answers for any
 * number of threads. It lives in the caller's memory:
 *   ents_tree_size    doubles that it takes (about segments * (1 + d))
 *   ents_tree_build   once; O(n log n), needs d doubles per segment of memory of its own while it works (NO_MEMORY)
 *   ents_tree_refit   whenever positions or surface coordinates have changed, and before the tree is used with a model of another height,
 *                     segment or border (a height that wears); O(n). ents_detect finds the right segments only in a tree that has been
 *                     refitted to the positions; a tree that was made with another height, segment or border is refused (BAD_STATE)
 * Errors: NULL_ARGUMENT, STRUCT_SIZE, BAD_COUNT, BAD_VALUE (a node that does not exist), NON_FINITE, BAD_STATE (not a tree
 * of this surface, or one that was written over; after an error it has to be built again). */
ENTS_API int32_t ents_tree_size(const ents_model *model, int64_t segments, int64_t *size, ents_report *report);
ENTS_API int32_t ents_tree_build(const ents_model *model, const ents_master_mesh *mesh, double *tree, int64_t size,
                                 ents_report *report);
ENTS_API int32_t ents_tree_refit(const ents_model *model, const ents_master_mesh *mesh, double *tree, int64_t size,
                                 ents_report *report);

/* Slave nodes and what was found for them. */
typedef struct ents_detection {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  const double *slave;               /* [count][d] positions, [L], finite */
  double reach;                      /* [L], > 0: a projection with a larger |gap| is none */
  int64_t *segment;                  /* [count] in: the segment of before, or -1; out: the segment, -1: nothing within reach */
  double *xi;                        /* [count][d-1] in (where segment >= 0): the projection of before; out: natural coordinates */
  double *gap;                       /* [count] out or null: [L], along n_e (normal) or along the ray (shadow); 0 where segment is -1 */
  int32_t *flags;                    /* [count] out or null: ENTS_FLAG_SEARCHED, _AMBIGUOUS, _BEHIND_EDGE */
  int64_t *other;                    /* [count] out or null: another segment with an equally good projection elsewhere, or on the other side
                                        of a sheet without thickness; or -1 */
  const int64_t *slave_node;         /* [count] or null: the node of the mesh that each slave is, or -1. Segments with this node in their
                                        connectivity are left out. Without it a slave that is a node of the master surface finds itself,
                                        at gap 0 (self-contact). Since contract 1.4 */
} ents_detection;

/* Project the slave nodes first .. first + count - 1 on the surface.
 *   normal   the closest of all projections on all segments
 *   shadow   of all points on the ray the one that is nearest to the light
 * A slave with a projection of before that is still on that segment and within reach keeps it: it stays on the branch it was
 * on, whatever else has come closer. Where it has left its segment, or has none, all segments are searched (ENTS_FLAG_SEARCHED),
 * and the answer is the best one of all, proved by bounds, or ENTS_FLAG_AMBIGUOUS is set: there are two equally good ones (the
 * one on the segment with the smaller number is given), or the proof took too long.
 * Edges (normal projection). A slave beyond the edges of all segments has no projection, unless it lies within the model's "border" of one.
 * Where a point of an edge is closer to the slave than every projection, the normals of the segments that meet there decide. Behind a
 * concave edge (a kink of a plain mesh) the slave has penetrated, but projects on neither segment: segment is -1 and
 * ENTS_FLAG_BEHIND_EDGE is set: cut the step, widen the border, or smooth the surface. Ahead of a ridge the slave is open: segment is -1,
 * and a farther face that it would project on from behind is no contact. Beside a free edge of the surface a slave is open, too.
 * (At a point where more than 64 segments meet nothing is proved: a slave whose closest point it is is flagged.)
 * Returns 0 or a negative status; then nothing is written from the node with the error on. */
ENTS_API int32_t ents_detect(const ents_model *model, const ents_master_mesh *mesh, const double *tree, int64_t size,
                             int64_t first, int64_t count, const ents_detection *detection, ents_report *report);

/* ---- evaluation ------------------------------------------------------------------------------- */

/* Inputs of contact elements: one slave node and one master segment each. `..._stride` is the
 * distance in doubles between consecutive elements; 0 means that all elements share the values (one
 * segment for many slave nodes, say). */
typedef struct ents_input {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  const double *slave;               /* [d] position, [L], finite */
  int64_t slave_stride;
  const double *master;              /* [m][d] positions, [L], finite */
  int64_t master_stride;
  const double *surface_coordinates; /* [m][d-1] s of each master node; null: the model's own, else s = xi */
  int64_t surface_coordinates_stride;
  const double *start;               /* [d-1] start of the projection, natural coordinates; null: search the whole segment */
  int64_t start_stride;
  const double *area;                /* [1] tributary area of the slave node, [A], >= 0; null: 1. Without area there is no force, and
                                        multiplier dofs are held at zero */
  int64_t area_stride;
  const double *state_begin;         /* [state_size] begin of increment, read only; null: no history.
                                        A state in contact overrides `start` */
  int64_t state_begin_stride;
  const double *multiplier;          /* [multipliers] values of the multiplier dofs: lambda_n [F/A], then with friction
                                        lambda_a [F L/A], covariant in xi; required if the layout has any */
  int64_t multiplier_stride;
  const ents_master_mesh *mesh;      /* with `segment`: nodes and surface coordinates come from here instead of `master`
                                        and `surface_coordinates`, which are then null */
  const int64_t *segment;            /* [1] index of the segment in `mesh`; as ents_detect gives it, but never -1. Not read without `mesh` */
  int64_t segment_stride;
} ents_input;

/* What to compute. What is not asked for is neither computed nor touched. */
#define ENTS_XI            (1 << 0)  /* xi            [d-1]          natural coordinates of the projection */
#define ENTS_GAP           (1 << 1)  /* gap           [1]    [L]     along n_e (normal) or along the ray (shadow) */
#define ENTS_NORMAL_GAP    (1 << 2)  /* normal_gap    [1]    [L]     (x_s - rho_e) . n_e */
#define ENTS_NORMAL        (1 << 3)  /* normal        [d]            n_e, unit normal of the enriched surface */
#define ENTS_POINT         (1 << 4)  /* point         [d]    [L]     rho_e at the projection */
#define ENTS_GAP_GRADIENT  (1 << 5)  /* gap_gradient  [n]            dg/du,       eq. (3); n = dofs - multipliers, here and below */
#define ENTS_GAP_HESSIAN   (1 << 6)  /* gap_hessian   [n][n]         d2g/du2,     eq. (4); [1/L]. Follows the model's "tangent" key */
#define ENTS_XI_GRADIENT   (1 << 7)  /* xi_gradient   [d-1][n]       dxi/du,      eq. (3); [1/L] */
#define ENTS_XI_HESSIAN    (1 << 8)  /* xi_hessian    [d-1][n][n]    d2xi/du2, eq. (4); [1/L^2]. Always exact; needs C3 of h with normal projection */
#define ENTS_ENERGY        (1 << 9)  /* energy        [1]    [F L]   W */
#define ENTS_PRESSURE      (1 << 10) /* pressure      [1]    [F/A]   -dW/dg / area; > 0 in contact */
#define ENTS_RESIDUAL      (1 << 11) /* residual      [dofs] [F]     R = dW/du */
#define ENTS_TANGENT       (1 << 12) /* tangent       [dofs][tangent_leading_dimension] [F/L]  K = dR/du */
#define ENTS_STATE         (1 << 13) /* state_end     [state_size]   must not overlap state_begin, but may lie between its blocks */
#define ENTS_FLAGS         (1 << 14) /* flags         [1] int32: ENTS_FLAG_... */
#define ENTS_ITERATIONS    (1 << 15) /* iterations    [1] int32: surface evaluations the projection took */
#define ENTS_TRACTION      (1 << 16) /* traction      [d]    [F/A]   tangential traction on the master, spatial vector */
#define ENTS_SLIP          (1 << 17) /* slip          [1]    [L]     accumulated slip of the state, end of increment */
#define ENTS_AGE           (1 << 18) /* age           [1]            increments since the last change of status */

/* Of a model with "contact", flags are those of the element, whatever else is wanted. */
#define ENTS_FLAG_CONTACT  1   /* the element carries pressure */
#define ENTS_FLAG_OUTSIDE  2   /* the projection lies outside the segment: open, R = 0, K = 0 */
#define ENTS_FLAG_FAR_SIDE 4   /* slave beyond a centre of curvature: the projection is not a minimum of the distance */
#define ENTS_FLAG_SEARCHED 8   /* the whole segment was searched */
#define ENTS_FLAG_STICK    16  /* friction: elastic */
#define ENTS_FLAG_SLIP     32  /* friction: |t| = limit */
#define ENTS_FLAG_SHEAR_LIMIT 64 /* the limit is the model's shear_limit */
#define ENTS_FLAG_AMBIGUOUS 256 /* ents_detect: two projections are equally good, or might be */
#define ENTS_FLAG_BEHIND_EDGE 512 /* ents_detect: the closest point is on an edge between segments, and the slave is behind it: not open, but lost */
#define ENTS_FLAG_CHANGED  128 /* open, stick or slip differs from the begin of the increment; a new state is open */

/* Outputs. Strides in units of the array's own type; the distance of consecutive elements, at least the size of one (else
 * BAD_COUNT): 0 is not "shared" as with inputs. With first = 0 and count = 1 alone strides are not read and may be 0. A
 * pointer may be null unless its bit is set in `wanted`. Outputs must not overlap each other or inputs, except that xi may take the
 * place of input.start (the same pointer and stride). */
typedef struct ents_output {
  int32_t struct_size;
  int32_t wanted;                      /* ENTS_... bits */
  int32_t *status;                     /* [1] per element, or null; written whatever `wanted` says */
  int64_t status_stride;
  double *xi;            int64_t xi_stride;
  double *gap;           int64_t gap_stride;
  double *normal_gap;    int64_t normal_gap_stride;
  double *normal;        int64_t normal_stride;
  double *point;         int64_t point_stride;
  double *gap_gradient;  int64_t gap_gradient_stride;
  double *gap_hessian;   int64_t gap_hessian_stride;
  double *xi_gradient;   int64_t xi_gradient_stride;
  double *xi_hessian;    int64_t xi_hessian_stride;
  double *energy;        int64_t energy_stride;
  double *pressure;      int64_t pressure_stride;
  double *residual;      int64_t residual_stride;
  double *tangent;       int64_t tangent_stride;
  int64_t tangent_leading_dimension;   /* >= dofs; 0 means dofs */
  double *state_end;     int64_t state_end_stride;
  int32_t *flags;        int64_t flags_stride;
  int32_t *iterations;   int64_t iterations_stride;
  double *traction;      int64_t traction_stride;
  double *slip;          int64_t slip_stride;
  double *age;           int64_t age_stride;
} ents_output;

/* Evaluate the elements first .. first + count - 1 of the arrays (a host's threads take ranges). count = 1 is the single
 * element; n elements give the same bits as n single calls. All levels are here: kinematics (ENTS_XI .. ENTS_XI_HESSIAN) to
 * build any method of eq. (3)-(4) with, and the element (ENTS_ENERGY .. ENTS_STATE), which needs "contact" in the model.
 * For a kinematic quantity alone the segment has no border: xi may lie outside. An element whose slave is so far beside the segment
 * that there is no projection is open (ENTS_FLAG_OUTSIDE): its xi, gap, normal and point are where the iteration left off.
 * A model with a "patch" has elements of several segments (for hosts whose elements have fixed nodes): m is then the number of the
 * patch's nodes, `start` is not used, and the segment is chosen as ents_detect does: a slave in contact is followed from `state_begin` on,
 * an open one is searched anew; xi and its variations are those of that segment. In the increment in which a slave with friction changes
 * its segment, the anchor moves over in the current positions, whose change the tangent leaves out (up to a third of its largest entry;
 * exact with "surface_coordinates" or a rigid master). A slave behind a concave edge is NO_PROJECTION. ents_surface_evaluate, ents_model_check and the
 * functions of whole surfaces take such a model's segments one by one.
 * Returns 0; or the first negative status, then outputs of elements before it are written; or, all elements having been
 * visited, the recoverable status of the first element that has one. */
ENTS_API int32_t ents_evaluate(const ents_model *model, int64_t first, int64_t count,
                               const ents_input *input, const ents_output *output,
                               ents_report *report);

/* Fill `count` state blocks for elements without history. stride >= state_size, in doubles. A state knows the segment type and the kinds of
 * normal law and friction, and refuses (BAD_STATE) to be read by a model of others; it knows neither the height nor the numbers of the
 * law: another model of the same kinds goes on with it (heights that wear between increments). A state that was written with
 * ents_input.mesh knows the number of its segment, too: with friction or multipliers in the state, an element on another segment refuses
 * it until ents_state_transfer has moved it. */
ENTS_API int32_t ents_state_init(const ents_model *model, int64_t count, double *state,
                                 int64_t stride, ents_report *report);

/* Augmented Lagrangian with multipliers in the state (Uzawa): after a converged solve, put the multipliers
 * of the end states into the begin states and solve the increment again, until penetration and slip are small. The rest
 * of `state_begin` stays: it is still the begin of the increment. Both arrays: stride >= state_size. */
ENTS_API int32_t ents_state_augment(const ents_model *model, int64_t count, double *state_begin, int64_t begin_stride,
                                    const double *state_end, int64_t end_stride, ents_report *report);

/* A slave node moves on to another segment: `state` as seen from the new one. The anchor of friction and the
 * multipliers move with the material of the master surface, so that no slip history is lost: through the
 * surface coordinates where both are given and lead to the same place (not over a seam, not if they are constant along the
 * segment), else to the closest point of the new segment (extended over its border).
 *   old_master, new_master  [m][d] positions, [L], both at the same instant (the begin of the increment)
 *   old_..., new_surface_coordinates  [m][d-1] or null: the model's own, else s = xi (then positions decide)
 *   state, moved            [state_size] in, out; may not overlap
 * Recoverable: NO_PROJECTION (of the anchor: without friction there is none), DEGENERATE_SEGMENT. */
ENTS_API int32_t ents_state_transfer(const ents_model *model, const double *old_master, const double *old_surface_coordinates,
                                     const double *new_master, const double *new_surface_coordinates,
                                     const double *state, double *moved, ents_report *report);

/* Tributary areas of slave nodes: of each facet, the part of its area that belongs to each node (row sums for linear
 * facets; lumped in proportion to the integral of N_i^2 for quadratic ones, so that all are positive).
 *   facet         "line2", "line3", "tri3", "tri6", "quad4", "quad8", "quad9"
 *   connectivity  [facets][nodes of the facet], 0 <= index < nodes
 *   positions     [nodes][d], [L]
 *   thickness     2D: the area of a length, [L]; axisymmetric bodies: 0, the areas are then of the full turn about the second axis. 3D: ignored
 *   areas         [nodes] out, [A]; 0 for nodes on no facet
 * Allocates (NO_MEMORY). Errors: NULL_ARGUMENT, BAD_COUNT, BAD_VALUE (a facet or node that does not exist, report.element; a thickness
 * that is not >= 0), NON_FINITE. Recoverable: DEGENERATE_SEGMENT (a facet without area, report.element). After any of them nothing is written. */
ENTS_API int32_t ents_tributary_areas(const char *facet, int64_t facets, const int64_t *connectivity, int64_t nodes,
                                      const double *positions, double thickness, double *areas, ents_report *report);

/* ---- points inside facets, and assembly -------------------------------------------------------- */

/* Points that are linear combinations of a host's nodes: sampling points inside slave facets, control points of a smoothed
 * master surface.  x_i = sum_j weights[j] X[nodes[j]],  j = begin[i] .. begin[i+1] - 1. The arrays stay the caller's. */
typedef struct ents_combination {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  int64_t points;
  const int64_t *begin;              /* [points + 1], begin[0] = 0, never falling */
  const int64_t *nodes;              /* [begin[points]], >= 0 */
  const double *weights;             /* [begin[points]] */
} ents_combination;

/* Positions of the points, or what else is given per node (surface coordinates).
 *   dimension  numbers per node: 1, 2 or 3
 *   positions  [nodes][d] of the host's nodes, [L], finite
 *   points     [points][d] out */
ENTS_API int32_t ents_combine(const ents_combination *combination, int32_t dimension, int64_t nodes, const double *positions,
                              double *points, ents_report *report);

/* Sampling points of slave facets, so that texture between slave nodes is seen and a constant pressure gives every
 * slave node its exact share (Zavarise and De Lorenzis, IJNME 79, 2009). Arguments as of ents_tributary_areas, and
 *   per_direction  n, 1 .. 64: lines have n points, triangles and quadrilaterals n^2. Lines and quadrilaterals: Gauss and
 *                  Legendre's; triangles: the centroids of n^2 equal parts
 *   begin          [points + 1] out, points = facets * points of a facet, those of a facet one after the other
 *   point_nodes    [points * nodes of the facet] out
 *   weights        [points * nodes of the facet] out
 *   areas          [points] out, [A]
 * begin, point_nodes and weights make an ents_combination. Allocates (NO_MEMORY). Statuses: those of ents_tributary_areas, DEGENERATE_SEGMENT
 * among them, and nothing is written after any of them. */
ENTS_API int32_t ents_sampling_points(const char *facet, int32_t per_direction, int64_t facets, const int64_t *connectivity,
                                      int64_t nodes, const double *positions, double thickness, int64_t *begin,
                                      int64_t *point_nodes, double *weights, double *areas, ents_report *report);

#define ENTS_ENDS_STRAIGHT 0 /* beyond a free end or border: 2 x_0 - x_1, x_1 the neighbour inside (x_0 a node of the border) */
#define ENTS_ENDS_REPEATED 1 /* x_0 once more */

/* A smoothed master surface over ordinary facets: one segment of a smoothed basis per facet, in the same order and with the
 * same natural coordinates, and control points that are linear combinations of the host's nodes. It follows from the connectivity
 * alone: make it once. From then on a surface is
 *   mesh.connectivity = segment_points, mesh.nodes = points, mesh.positions = ents_combine(positions of the nodes),
 * and ents_assemble, told of the combination in system.master, puts residual and tangent on the host's own nodes.
 *   facet -> basis
 *   line2 -> catmull_rom4   through the nodes; C1
 *   line2 -> bspline4       near the nodes (at x the curve is at x_(i-1)/6 + 2 x_i/3 + x_(i+1)/6); C2
 *   quad4 -> catmull_rom16  through the nodes; C1. Regular meshes: four facets meet in every inner node, two in every node of a
 *                           border, one in a corner
 *   quad4 -> bspline16      near the nodes; any mesh. C2 where facets are regular. A facet with an extraordinary node (where it is not
 *                           so) has a bicubic patch near the Catmull-Clark surface (C. Loop and S. Schaefer, ACM TOG 27(1), 2008;
 *                           next to extraordinary nodes C. Loop, S. Schaefer, T. Ni, I. Castano, ACM TOG 28(5), 2009). It meets
 *                           all its neighbours; along edges that do not end in an extraordinary node with one normal, along
 *                           those that do with one at their ends and a kink between them: 2 to 5 % of the angle between the plain
 *                           facets for nodes of 3 to 8 facets
 *   tri3  -> bezier15       near the nodes; any mesh. Quartic patches: Loop's subdivision surface (1987), C2, where six facets meet in
 *                           every corner; else as above, with a kink of 2 to 7 % for nodes of 3 to 8 facets. Straight ends only: the
 *                           nodes of facets at a border are reflected in it, which makes regular borders the splines of
 *                           their nodes; x is at x / 2 + (sum of its six neighbours) / 12. Searches on bezier15 are slow (tests/bench/README.md)
 * Free ends and borders: `ends`, in both directions beyond a corner (straight: 4 x_00 - 2 x_10 - 2 x_01 + x_11). Straight ends
 * keep corners and the ends of lines in their places, regular borders of bspline16 are the splines of their nodes, and
 * straight rows of equidistant nodes give equidistant points; beyond a node of a border with several inner neighbours: 2 x_0 - their mean.
 * With repeated ends, control points of regular meshes are single nodes; bspline surfaces then end short of their borders.
 * Facets must be oriented alike. Chains and surfaces may be several, open or closed.
 *   facet, basis    as above, zero-terminated
 *   ends            ENTS_ENDS_...
 *   connectivity    [facets][nodes of the facet], 0 <= index < nodes
 *   points, terms   sizes of what ents_smooth fills: ents_smooth_size gives them
 *   segment_points  [facets][m] out
 *   begin           [points + 1] out
 *   point_nodes     [terms] out
 *   weights         [terms] out; those of a point add up to 1
 * begin, point_nodes and weights make an ents_combination; its points 0 .. nodes - 1 are the nodes themselves.
 * Errors: BAD_VALUE names facet and node: a node that does not exist or is twice in a facet; more than two facets that meet in a
 * node (lines) or along an edge; neighbours that are not oriented alike; facets that touch in a node alone; an inner node of two
 * facets; an irregular mesh for catmull_rom16. BAD_COUNT: sizes that are not those of ents_smooth_size. Both allocate (NO_MEMORY); after an error nothing is written. */
ENTS_API int32_t ents_smooth_size(const char *facet, const char *basis, int32_t ends, int64_t facets,
                                  const int64_t *connectivity, int64_t nodes, int64_t *points, int64_t *terms,
                                  ents_report *report);
ENTS_API int32_t ents_smooth(const char *facet, const char *basis, int32_t ends, int64_t facets, const int64_t *connectivity,
                             int64_t nodes, int64_t points, int64_t terms, int64_t *segment_points, int64_t *begin,
                             int64_t *point_nodes, double *weights, ents_report *report);

/* The host's equations. */
typedef struct ents_system {
  int32_t struct_size;
  int32_t index_size;                /* 4 or 8: bytes of an index in row_begin and columns */
  const ents_combination *slave;     /* slave points over the host's nodes; null: slave point i is node i */
  const ents_combination *master;    /* nodes of the mesh (control points) over the host's nodes; null: node i is node i */
  int64_t slave_nodes;               /* nodes of the host that slave_equations covers */
  const int64_t *slave_equations;    /* [slave_nodes][d] row of each dof; -1: prescribed, left out */
  int64_t master_nodes;
  const int64_t *master_equations;   /* [master_nodes][d]; not read for a rigid master. May be slave_equations */
  const int64_t *multiplier_equations; /* [elements][multipliers]; needed if the layout has any */
  int64_t rows;
  double *residual;                  /* [rows] R is added; null: not wanted */
  const void *row_begin;             /* [rows + 1] compressed rows, counted from 0: the first is 0 */
  const void *columns;               /* [row_begin[rows]] ascending in each row */
  double *values;                    /* [row_begin[rows]] K is added; null: not wanted */
  int64_t *places;                   /* [elements][places_size] or null: where the entries of each element are in `values`, kept
                                        from call to call: zero it once, and whenever row_begin or columns change. Other segments, nodes
                                        or equations of an element are noticed */
  int64_t places_size;               /* at least d (m+1)^2 + 1 (rigid: d + 1); not used with a `slave` or `master` combination */
} ents_system;

/* ents_evaluate, and what is an element's goes into the host's equations: residual and tangent are added to `system` (and
 * must not be asked for in output.wanted). The segments come from input.mesh and input.segment, as ents_detect gives
 * them; an element with segment -1 is open: its flags are ENTS_FLAG_OUTSIDE, its state is that of ents_state_init, all else zero but
 * the equations "multiplier = 0" of open elements, R = -A/eps lambda, K = -A/eps. Its inputs are checked as those of all others; `start` is not read.
 * What is open adds nothing but these equations. Where no results per element are asked for, elements that are
 * clearly open (the slave above all of a line2 or tri3 and its height's bound, or of a plain quad4) are not projected.
 * Ranges of one system may run at the same time only if they have no row in common; elements are added in their order.
 *   output  results per element as of ents_evaluate, or null
 * Errors: those of ents_evaluate; BAD_PATTERN names the row and column that the pattern lacks. After an error or a
 * recoverable status the system holds a part of the sum: start again from zero. */
ENTS_API int32_t ents_assemble(const ents_model *model, int64_t first, int64_t count, const ents_input *input,
                               const ents_output *output, const ents_system *system, ents_report *report);

/* All of an iteration in one call: ents_detect, then ents_assemble of the elements found (system null: results per element only,
 * residual and tangent among them if wanted). `input` gives areas, states and multipliers; its slave, master, mesh, segment
 * and start must be null: they come from the detection, the start even where input.state_begin has one. A slave that is lost
 * (ENTS_FLAG_BEHIND_EDGE) ends it with NO_PROJECTION. All arguments but the numbers of single slaves and elements are checked before anything is
 * written. With friction use the two calls: a state has to follow its slave to another segment
 * in between (ents_state_transfer). */
ENTS_API int32_t ents_iterate(const ents_model *model, const ents_master_mesh *mesh, const double *tree, int64_t size, int64_t first,
                              int64_t count, const ents_detection *detection, const ents_input *input, const ents_output *output,
                              const ents_system *system, ents_report *report);

/* ---- the enriched surface itself --------------------------------------------------------------- */

/* Points of the surface, for pictures, meshes and checks. Pointers that are null are skipped. Those before a point that is refused
 * (report.element) are written. */
typedef struct ents_surface {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  const double *master;              /* [m][d], [L] */
  const double *surface_coordinates; /* [m][d-1] or null: the model's own, else s = xi */
  const double *xi;                  /* [count][d-1] in */
  double *point;                     /* [count][d] out: rho_e, [L] */
  double *normal;                    /* [count][d] out: n_e */
  double *height;                    /* [count] out: h, [L] */
  double *base_point;                /* [count][d] out: rho, [L] */
  double *base_normal;               /* [count][d] out: n */
} ents_surface;

ENTS_API int32_t ents_surface_evaluate(const ents_model *model, int64_t count,
                                       const ents_surface *surface, ents_report *report);

/* Is the enrichment admissible on this segment? (conditions of section 3 and Fig. 4 of the paper, on a
 * regular grid of `samples` points per direction). Worst values and where they are. */
typedef struct ents_admissibility {
  int32_t struct_size;
  int32_t samples;            /* in: points per direction, 2 .. 4096; 0: as fine as the height asks for. out: taken (0 again for another segment) */
  int32_t continuity;         /* h is C^continuity; 1000: smooth */
  int32_t reserved;           /* 0 */
  double fold;                /* max |h| |kappa| over the segment; >= 1: rho_e folds over itself */
  double fold_xi[2];
  double edge_height;         /* max |h| on the segment's edges, [L]; must be 0 for local enrichment (s = xi) */
  double edge_height_xi[2];
  double reach;               /* min 1/|kappa_e| of the enriched surface, [L]: farther away a normal projection is not unique */
  double reach_xi[2];
  double shadow;              /* min n_e . e with the ray through each surface point; <= 0: self-shadow. 1 for normal projection */
  double shadow_xi[2];
  double height_min, height_max; /* [L] */
} ents_admissibility;

ENTS_API int32_t ents_model_check(const ents_model *model, const double *master,
                                  const double *surface_coordinates, ents_admissibility *result,
                                  ents_report *report);

/* Conditions of a whole surface (sections 2 and 3 and Fig. 4 of the paper): name, place in the arrays below, and the bound that the
 * worst value is held against. Grids and facets measure them: what is smaller than the distance of the samples may be missed. */
#define ENTS_CONDITION_TABLE(X)                                                                                        \
  X(ENTS_CHECK_CONTINUITY, 0, "derivatives of h: at least 2; with 3 the exact tangent of friction is continuous, too") \
  X(ENTS_CHECK_FOLD, 1, "max |h| |kappa| of rho: below 1, else rho_e folds over itself")                               \
  X(ENTS_CHECK_EDGE, 2, "max |h| on the edges [L]: 0 for a local enrichment (s = xi, not smoothed); else not judged")  \
  X(ENTS_CHECK_JUMP, 3, "max distance of the two rho_e on an edge of two segments [L]: 0")                             \
  X(ENTS_CHECK_KINK, 4, "max angle between the two n_e on such an edge [rad]: at most `kink`")                         \
  X(ENTS_CHECK_WEDGE, 5, "min angle free outside between two segments at their edge [rad]: above 0")                   \
  X(ENTS_CHECK_PROJECTION, 6, "min |gap| at which a slave has two normal projections [L]: at least `reach`")           \
  X(ENTS_CHECK_SHADOW, 7, "min n_e . e of the ray through each point: above 0, else self-shadow")                      \
  X(ENTS_CHECK_OCCLUSION, 8, "max distance along the ray to another part of the surface in its light [L]: 0")          \
  X(ENTS_CHECK_CROSSING, 9, "max depth of a segment behind another that it intersects [L]: 0")

enum {
#define ENTS_CONDITION_ENUM(name, value, text) name = value,
  ENTS_CONDITION_TABLE(ENTS_CONDITION_ENUM)
#undef ENTS_CONDITION_ENUM
  ENTS_CHECK_COUNT_ = 16 /* room in the arrays */
};

/* Is the enrichment admissible on a whole surface? All arrays: one entry per condition.
 *   judged       bit 1 << ENTS_CHECK_...: the model, the surface or the caller sets a bound; else the value is for information
 *   violated     the same: the value is beyond its bound. Bounds of 0 [L] leave room for rounding, see `bound`
 *   projection   normal projection only. Places beside a kink between two segments have two projections by nature and do not
 *                count. Without a reach: the smallest radius of curvature of rho_e alone
 *   shadow, occlusion   shadow projections only
 *   kink, edge, jump, wedge   neighbours are segments that share the nodes at the ends of an edge (smoothed segments: the inner
 *                nodes, between which they lie); `kink` does not depend on whether the base has it, too
 *   crossing     of a segment with itself: what sticks through one facet, a lower bound
 * Allocates (NO_MEMORY): about 200 bytes per sample; 2^18 samples, or the corners of all segments if they are more. Takes
 * seconds for 10^6 samples: once per surface and motion of interest, not once per iteration. */
typedef struct ents_surface_admissibility {
  int32_t struct_size;
  int32_t samples;         /* in: points per direction and segment, 2 .. 4096; 0: as fine as the height asks for. out: most taken */
  double reach;            /* in: [L], a slave is searched up to this |gap|; 0: the model's penetration_limit, if it has one */
  double kink;             /* in: [rad], tolerated between neighbours; 0: not judged */
  int64_t *violations;     /* [segments] out or null: bits 1 << ENTS_CHECK_... that this segment violates */
  int64_t judged;          /* out, and all below */
  int64_t violated;
  double value[16];        /* the worst; infinite if there is none (a flat surface has no smallest radius) */
  double bound[16];
  double missing[16];      /* > 0: by how much the value misses its bound; 0: it holds, or is not judged */
  int64_t segment[16];     /* where; -1: nowhere, or everywhere */
  double xi[16][2];
  double point[16][3];     /* rho_e there [L]; 2D: third entry 0 */
  int64_t other[16];       /* the other segment of an edge or a pair; may be the same; -1: none */
  double other_xi[16][2];
  double height_min, height_max; /* [L] */
} ents_surface_admissibility;

/* Errors: NULL_ARGUMENT, STRUCT_SIZE, BAD_COUNT, BAD_VALUE, NON_FINITE, NO_MEMORY. Recoverable: DEGENERATE_SEGMENT (a plain
 * segment without a normal, report.element). A surface that is not admissible is no error: 0, and `violated` says so. */
ENTS_API int32_t ents_surface_check(const ents_model *model, const ents_master_mesh *mesh,
                                    ents_surface_admissibility *result, ents_report *report);

#ifdef __cplusplus
}
#endif
#endif

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
 *     model says "master": "rigid"); with "heat" the temperature of a node follows its displacements; matrices are column-major;
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
 *                                       A quad4 with two neighbouring nodes in one place, as one index twice, is a triangle
 *   quad8, quad9              square    corners as quad4, then the middles of the sides 01, 12, 23, 30; quad9: then the centre
 *   catmull_rom4, bspline4    line      four points in a row. The segment lies between the middle two: catmull_rom4 begins in point 1
 *                                       and ends in 2, bspline4 at (x_0 + 4 x_1 + x_2) / 6 and (x_1 + 4 x_2 + x_3) / 6
 *   catmull_rom16, bspline16  square    four rows of four: point 4 j + i, i grows with xi_1, j with xi_2. The segment lies between the
 *                                       middle four: the corners of catmull_rom16 are points 5, 6, 10, 9, in the order of quad4
 *   bezier15                  triangle  control points: corners as tri3, then three on each of the sides 01, 12, 20, in its direction,
 *                                       then the three inner ones, each next to its corner
 * The normal has to point out of the master's body, towards the slave nodes. 2D: the normal is on the left of the direction from the
 * first end of the line to the second (direction +x: normal +y). 3D: seen from the tip of the normal, the corners go round
 * counter-clockwise (counter-clockwise in the plane of x and y: normal +z). The library cannot detect a wrong order of nodes: on a
 * segment with the reversed normal, open slave nodes are pressed and penetrating ones are open; a quadratic segment whose middle nodes
 * stand between the corners in the list is another surface.
 * A surface of triangles and quadrilaterals is one of quad4: the triangle a b c is the row a b c c. All functions take such rows, as
 * segments, as slave facets and in a "patch"; ents_smooth and ents_surface_check refuse them. Surface coordinates of the two nodes in one place have to be equal. Natural
 * coordinates have no meaning in that corner: projections and points of the surface stay 1e-9 of a side away from it, with a height 1e-6
 * (as exact are the forces of a slave node right there, unless another segment meets it with an ordinary corner: ents_detect takes that one),
 * and a height in natural coordinates (s = xi) has a crease there. Friction measures the elastic slip in natural coordinates: where it is not
 * small beside the distance to that corner, the tangential force is inexact. With friction prefer a master of tri3 alone.
 *
 * Words
 *   slave node         the point of an element that must not pass through its segment
 *   open, in contact   an element without, with contact pressure
 *   history, state     what an element remembers from one increment to the next (projection, friction, multipliers), in the host's memory
 *   anchor             the point of the master surface at which friction holds a slave node that sticks
 *   reach              the largest |gap| at which a search finds a slave node
 *   border             natural coordinates by which a segment reaches beyond its edges (key "border" of the model)
 *   patch              several segments in one element, for hosts whose elements have fixed nodes
 *   shadow projection  projection along a given direction, or towards a point, instead of along the normal. The direction e points from the
 *                      master to the light, on the side of the slave nodes: n_e . e > 0. Seen from behind (n_e . e < 0) a segment has no contact:
 *                      GRAZING_RAY where the slave node would be pressed, open elsewhere
 *
 * Rules
 *   - a model is the only handle. It is immutable: any number of threads may evaluate it at once. (One that ents_model_bind has made
 *     changes in that call alone);
 *   - an evaluation is a pure function: the same inputs give the same bits, whatever the thread, the
 *     batch, or the calls before. It allocates nothing, prints nothing, throws nothing, takes no lock,
 *     and leaves the floating-point environment (rounding, traps, flags) as it found it;
 *   - a call needs up to 256 KiB of stack (100 KiB for one element of one segment; ents_model_create needs more): the threads of a host
 *     need that much (OpenMP: OMP_STACKSIZE);
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
#define ENTS_CONTRACT_MINOR 11

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

/* A height function of the host: h and its derivatives at `count` points.
 *   user_data  as registered
 *   order      2 or 3: derivatives up to this one are wanted
 *   count      1 .. 8
 *   s          [d-1][count] surface coordinates: s_1 of all points, then s_2
 *   jet        [numbers][count] out, [L] per unit of s. numbers, with one surface coordinate: order + 1, in the order h, h_1, h_11, h_111;
 *              with two: 6 or 10, in the order h, h_1, h_2, h_11, h_12, h_22, h_111, h_112, h_122, h_222
 * Returns 0. Any other value means that the height is not defined at one of the points: it is then undefined at all of them, and the
 * projection ends with ENTS_NO_PROJECTION. The same is true of points whose numbers are NaN.
 * The function is called by all threads that evaluate a model, several at a time. The same s must give the same bits at any time, for
 * any count and order, else results differ between calls. It must not call this library, throw, or jump. It runs with rounding to nearest
 * and without traps. It should be continuous with its derivatives up to the third: tangents have third derivatives. */
typedef int32_t (*ents_height_function)(void *user_data, int32_t order, int32_t count, const double *s, double *jet);

/* Register a height function under a name: models that are made afterwards may say {"type": "callback", "name": NAME, ...}. Since
 * contract 1.6.
 *   name       zero-terminated, 1 to 64 bytes; copied
 *   dimension  d-1: surface coordinates, 1 (segments that are lines) or 2. One name may have a function of each
 *   function   replaces an earlier one of this name and dimension for models to come; null: the name is forgotten
 *   user_data  given to the function; may be null
 * A model copies both pointers when it is made: function and user_data have to live as long as the models that use them.
 * Takes a lock: any thread may call it, but not from within a height function. Errors: NULL_ARGUMENT, BAD_VALUE, BAD_COUNT (more than
 * 4096 names), NO_MEMORY. */
ENTS_API int32_t ents_height_register(const char *name, int32_t dimension, ents_height_function function, void *user_data,
                                      ents_report *report);

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
  int32_t dofs;                /* node_dofs (m+1), or node_dofs for a rigid master; plus multipliers */
  int32_t state_size;          /* per element */
  int32_t symmetric_tangent;   /* 1 if K = K^T always */
  int32_t own_surface_coordinates; /* 1 if the model text carries them */
  int32_t multipliers;         /* dofs of multipliers, after those of the nodes: 0, 1, or d with friction */
  int32_t friction;            /* 1 if the law has friction */
  int32_t augmentable;         /* 1 if the multipliers live in the state: ents_state_augment */
  int32_t needs;               /* ENTS_NEEDS_... bits (since contract 1.3, as what follows; `reserved` before) */
  const char *instruction_set; /* of the kernels of its residuals and tangents: "portable", "avx2", "avx512", to the same bits; "none":
                                  the library has none for this processor, is slower, and right to rounding. Static text */
  int32_t named_parameters;    /* of the model's key "parameters": ents_model_bind (since contract 1.6, as what follows) */
  int32_t fields;              /* heights of type "field": ents_model_bind */
  int32_t worn;                /* wear: place in the state of three numbers: depth lost by the slave surface [L]; depth lost by the
                                  master surface that no field has yet [L], see ents_wear_collect; pressure [F/A]; else -1 */
  int32_t slave_values;        /* numbers of ents_input.slave_values: 3, or 4 with a normal law "table" (since contract 1.7;
                                  `reserved` before) or one that adheres (since 1.11) */
  int32_t node_dofs;           /* dofs of a node: d, or d + 1 with heat (since contract 1.10, as what follows) */
  int32_t heat;                /* 1 if the law has "heat": temperatures are dofs, the last one of each node */
} ents_layout;

/* What the elements of a model need. ents_model_create decides it from the model's text; what is not needed is not computed. (Results
 * that output.wanted does not have are not computed either, and the evaluation of an open element ends with its gap.) `ents-bench
 * --savings` measures the time that each bit costs. */
#define ENTS_NEEDS_HEIGHT      (1 << 0)  /* a height that is not zero everywhere; without this bit the segments are evaluated as plain ones */
#define ENTS_NEEDS_SLOPE       (1 << 1)  /* a height of another type than "constant": each step of a projection evaluates its derivatives */
#define ENTS_NEEDS_CURVED      (1 << 2)  /* segments whose normal varies (all but line2 and tri3): projection and variations have its derivatives */
#define ENTS_NEEDS_ITERATION   (1 << 3)  /* projections by Newton's method; else (plain line2, tri3) in closed form */
#define ENTS_NEEDS_MASTER      (1 << 4)  /* a master that deforms: R and K have its dofs; without ("master": "rigid") those of the slave alone */
#define ENTS_NEEDS_FRICTION    (1 << 5)  /* tangential forces and their limit; else K is symmetric and no anchor is kept */
#define ENTS_NEEDS_HISTORY     (1 << 6)  /* the force depends on ents_input.state_begin (friction, multipliers in the state); without, it
                                            depends on positions alone, and the state only gives the start of the projection */
#define ENTS_NEEDS_MULTIPLIERS (1 << 7)  /* dofs of multipliers after those of the nodes */
#define ENTS_NEEDS_ONE_BY_ONE  (1 << 8)  /* the elements of a call are evaluated one after the other; without this bit several at once, in
                                            the lanes of vector registers. It is set for patches, for laws with multipliers as dofs, and
                                            for segments of more than nine nodes unless the model has the normal projection, a penalty or
                                            power law and the consistent tangent */

#define ENTS_NEEDS_TEMPERATURES (1 << 9) /* "heat": a temperature per node. Since contract 1.10 */
#define ENTS_NEEDS_FIRST_STATE (1 << 10) /* bonds form where the undeformed bodies are close ("tied", "cohesive"): see "The first increment"
                                            at ents_input. Since contract 1.11 */

ENTS_API int32_t ents_model_layout(const ents_model *model, ents_layout *layout, ents_report *report);

/* ---- heights and laws that change -------------------------------------------------------------- */

/* Numbers of a model may be named parameters: {"parameters": {"wear": 0.1}, "height": {"type": "scale", "by": "wear", "of": ...}}, and
 * a height may be a field, {"type": "field", "name": "worn", ...}, a height map in the caller's memory. ents_model_bind makes a model
 * with the caller's values of both; every function takes it in place of the model that it was made from.
 *   model        the model, or one bound to it
 *   parameters   [named_parameters] their values, in the alphabetical order of their names; null: those of the text
 *   fields       one for each field of the model: its name; `values`: the block of ents_field_init, which the bound model reads until it is
 *                bound again; rows 1; columns: length of the block. Null, 0 if the model has none
 *   bound        in and out. Null: a new model, to be destroyed as any other, before or after `model`. One that this function made from
 *                the same model: it gets the new values; that allocates nothing and takes less than 1 us for small heights
 * Bind again after a field has changed. No thread may use `bound` during the call. Trees of ents_tree_build have to be refitted when the
 * values of the height have changed (else BAD_STATE). Errors: NULL_ARGUMENT, STRUCT_SIZE, BAD_COUNT, BAD_HANDLE (`bound` is no model bound to
 * `model`), NON_FINITE, BAD_VALUE (a stiffness that is not positive, a coefficient of friction or wear that is negative), BAD_STATE (a
 * field that is missing, or whose block was not made by ents_field_init), NO_MEMORY. After an error `bound` is as it was. */
ENTS_API int32_t ents_model_bind(const ents_model *model, const double *parameters, const ents_data *fields, int64_t field_count,
                                 ents_model **bound, ents_report *report);

/* Place of a named parameter among `parameters`.
 *   name   zero-terminated
 *   place  out
 * Errors: BAD_VALUE, the message has the names of the model. */
ENTS_API int32_t ents_parameter_place(const ents_model *model, const char *name, int64_t *place, ents_report *report);

/* The block of numbers of a field: a header, then the B-spline coefficients of the map.
 *   ents_field_size    number of doubles of the block
 *   ents_field_init    the spline through samples
 *   ents_field_sample  the field's heights at places of the surface
 * Arguments
 *   model    the model, bound or not
 *   name     of the field, zero-terminated
 *   size     of ents_field_size: out; of the others: length of the block
 *   samples  [points_2][points_1] at the places of a height map's samples, [L], finite; null: zero
 *   block    [size], the caller's; copy it to save the field
 *   count    number of places, >= 0
 *   s        [count][d-1] surface coordinates, finite
 *   height   [count] out, [L]
 * Errors: NULL_ARGUMENT, BAD_COUNT, BAD_VALUE (no such field), NON_FINITE, BAD_STATE (no block of this field), NO_MEMORY (ents_field_init). */
ENTS_API int32_t ents_field_size(const ents_model *model, const char *name, int64_t *size, ents_report *report);
ENTS_API int32_t ents_field_init(const ents_model *model, const char *name, const double *samples, double *block, int64_t size,
                                 ents_report *report);
ENTS_API int32_t ents_field_sample(const ents_model *model, const char *name, const double *block, int64_t size, int64_t count,
                                   const double *s, double *height, ents_report *report);

/* ---- whole surfaces --------------------------------------------------------------------------- */

/* A master surface: many segments of the model's basis over one set of nodes. The caller owns the arrays. */
typedef struct ents_master_mesh {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  int64_t segments;
  const int64_t *connectivity;       /* [segments][m], 0 <= index < nodes */
  int64_t nodes;
  const double *positions;           /* [nodes][d] current positions, [L], finite */
  const double *surface_coordinates; /* [segments][m][d-1] s of each segment's nodes (per segment, since a node on a seam has
                                        two values); null: those of the model's text, or s = xi if it has none */
  const double *temperature;         /* [nodes] for a model with "heat", else not read; also of a rigid master. Since contract 1.10 */
} ents_master_mesh;

/* Detection finds the segment that a slave node is projected on. A tree of boxes around the enriched segments makes the search fast. The
 * tree lies in memory of the caller, and any number of threads may search it at once:
 *   ents_tree_size    number of doubles of the tree (about segments * (1 + d))
 *   ents_tree_build   makes the tree, once: O(n log n). Allocates d doubles per segment while it works (NO_MEMORY)
 *   ents_tree_refit   fits the boxes to new positions: O(n). Call it whenever positions or surface coordinates have changed, and before
 *                     the tree is used with a model of another height, segment or border (a height that wears). If you skip this
 *                     call after the positions have changed, ents_detect finds wrong segments or none and reports no error; a
 *                     tree that was made with another height, segment or border is refused (BAD_STATE)
 * Arguments
 *   model, mesh  the model, and the surface as it is now
 *   segments     number of segments, 0 .. 2^40
 *   size         of ents_tree_size: out; of the others: length of `tree`, at least that number
 *   tree         [size], the caller's
 * Errors: NULL_ARGUMENT, STRUCT_SIZE, BAD_COUNT, BAD_VALUE (a node that does not exist), NON_FINITE, BAD_STATE (the memory holds no
 * tree of this surface, or was written over). After an error the tree has to be built again. */
ENTS_API int32_t ents_tree_size(const ents_model *model, int64_t segments, int64_t *size, ents_report *report);
ENTS_API int32_t ents_tree_build(const ents_model *model, const ents_master_mesh *mesh, double *tree, int64_t size,
                                 ents_report *report);
ENTS_API int32_t ents_tree_refit(const ents_model *model, const ents_master_mesh *mesh, double *tree, int64_t size,
                                 ents_report *report);

/* Boxes around the enriched segments, with their heights and borders: those that a tree is made of. Where a surface is distributed over
 * processes, they tell which master facets another process needs as ghosts: those whose box is nearer to its slave nodes than
 * the reach. Since contract 1.11
 *   model, mesh  as of ents_tree_build
 *   boxes        [segments][2 d] out: low[d], high[d] of each, [L]
 * Errors: those of ents_tree_build; the boxes before that of report.element are then written. */
ENTS_API int32_t ents_surface_boxes(const ents_model *model, const ents_master_mesh *mesh, double *boxes, ents_report *report);

/* Slave nodes, and the segments that ents_detect finds for them. */
typedef struct ents_detection {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  const double *slave;               /* [count][d] positions, [L], finite */
  double reach;                      /* [L], > 0: a projection with a larger |gap| is none */
  int64_t *segment;                  /* [count] in: the segment of the last projection, or -1; out: the segment, or -1: none within reach */
  double *xi;                        /* [count][d-1] in (where segment >= 0): natural coordinates of the last projection; out: of this one */
  double *gap;                       /* [count] out or null: [L], along n_e (normal) or along the ray (shadow); 0 where segment is -1 */
  int32_t *flags;                    /* [count] out or null: ENTS_FLAG_SEARCHED, _AMBIGUOUS, _BEHIND_EDGE, _LEFT */
  int64_t *other;                    /* [count] out or null: another segment with an equally good projection elsewhere, or on the other side
                                        of a sheet without thickness; or -1 */
  const int64_t *slave_node;         /* [count] or null: the node of the mesh that each slave is, or -1. Segments with this node in their
                                        connectivity are left out. Without it a slave that is a node of the master surface finds itself,
                                        at gap 0 (self-contact). Since contract 1.4 */
  int64_t permitted;                 /* ENTS_FLAG_LEFT, ENTS_FLAG_BEHIND_EDGE: slaves with this flag do not end the call with
                                        ENTS_NO_PROJECTION: the caller looks at `flags`. Since contract 1.5. ENTS_FLAG_CROSSED: ways are
                                        not looked at. Since contract 1.8 */
  const double *slave_begin;         /* [count][d] positions at the begin of the increment, [L], or null: ways are not looked at. Since contract 1.8 */
  const double *positions_begin;     /* [nodes][d] of the mesh at the begin of the increment, [L]; null: the mesh does not move. Since contract 1.8 */
  const double *slave_normal;        /* [count][d] of the slave's own surface, out of its body, of any length, or null. Segments that look the same way
                                        are left out (below); zeros: none are, for this slave. Since contract 1.9 */
  const int64_t *slave_segment;      /* [count] or null: the segment of the mesh on which each slave lies, or -1. It and the segments that share a node
                                        with it are left out, as those of slave_node. Since contract 1.11, as what follows */
  const double *depth;               /* [count] > 0 [L], or null: a slave that is behind a segment by more is not in contact with it (self-contact:
                                        half the thickness of the body below the slave, ents_thickness) */
  const int32_t *slave_side;         /* [count], [segments], or both null: numbers of the sides; segments of the slave's own side are left out. For two
                                        passes, in which each of two surfaces is slave and master */
  const int32_t *segment_side;
} ents_detection;

/* Project the slave nodes first .. first + count - 1 on the surface.
 *   model, mesh       the model, and the surface as it was when the tree was built or last refitted
 *   tree, size        of ents_tree_build
 *   first, count      range of slave nodes, >= 0; threads may take ranges of one ents_detection
 *   detection         slave nodes and results
 * Which projection: with normal projection the closest one on all segments; with shadow projection the point on the ray that is nearest
 * to the light.
 * Following. A slave node with segment >= 0 when the call begins is projected on that segment, from detection.xi on. If the projection
 * lies on the segment and within reach, it is the answer, even if another segment is closer: the slave node stays on the branch that
 * it was on. In all other cases all segments are searched (ENTS_FLAG_SEARCHED). The answer is then proved, by bounds, to be the best one;
 * ENTS_FLAG_AMBIGUOUS is set if a second one is equally good (the segment with the smaller number is returned), or if the proof
 * takes more than a bounded number of steps.
 * Segments that look away. With `slave_normal`, a segment whose normal (rho without its height, at its middle) makes an angle of less than
 * 93 degrees with that of the slave is left out of the search: at the corner of a body whose whole boundary is the master, the slave above
 * one side is never taken by the next one. A slave that is followed keeps its segment.
 * Self-contact of one surface: slave_normal, slave_node or slave_segment, and depth. With depth, segments are left out whose normal makes an
 * angle of less than 120 degrees with that of the slave, an edge that is farther behind a slave than its depth is none, too, and the way
 * (below) is looked at in steps of depth / 2 where that is less than reach / 2.
 * Edges (normal projection). A slave node beyond the edges of all segments has no projection, unless it lies within the model's
 * "border" of one. Where a point of an edge is closer to the slave node than every projection, the normals of the segments that meet
 * there decide. Behind a concave edge (a kink of a plain mesh) the slave node has penetrated, but projects on neither segment: segment is
 * -1 and ENTS_FLAG_BEHIND_EDGE is set. Take a smaller step, widen the border, or smooth the surface. Ahead of a ridge the slave node is
 * open: segment is -1, even if it lies behind a farther face. Beside a free edge of the surface a slave node is open, too.
 * (Where more than 64 segments meet in the closest point of a slave node, ENTS_FLAG_BEHIND_EDGE is set without a proof.)
 * Lost contact. A slave that had a segment (segment >= 0 when the call begins) and finds none is open if it has risen from the surface.
 * Otherwise its contact is lost: it is behind an edge (ENTS_FLAG_BEHIND_EDGE), or ENTS_FLAG_LEFT is set because it lies beside a free
 * edge and not above the surface as it would go on there (not above its greatest height, if it has one), or deeper than `reach`. All
 * slaves are then written, and the call returns ENTS_NO_PROJECTION for the first of them, unless `permitted` has the flag. Set
 * segment = -1 for open slaves before the call: they may leave the surface as they like. The call does not look for lost contact if the
 * caller's ents_detection ends before `permitted`.
 * The way. With `slave_begin`, a slave that moves by more than `reach` / 2 relative to the mesh (less its mean motion) and is in front of the
 * surface at the begin and at the end is looked for on its straight way, at places reach / 2 apart: if it is behind the surface there, it
 * has passed through, and the call returns ENTS_NO_PROJECTION, with report.step_factor so that the increment ends there. It does so, too, if
 * the way near the surface is longer than 32 reach. A part of the body that is thinner than reach / 2 may be missed. Each such call reads the
 * positions of all nodes once: take long ranges. Allocates (NO_MEMORY) if there are such slaves.
 * Returns 0; ENTS_NO_PROJECTION as just said, after everything has been written; or a negative status, and then nothing is written from
 * the slave with the error on. */
ENTS_API int32_t ents_detect(const ents_model *model, const ents_master_mesh *mesh, const double *tree, int64_t size,
                             int64_t first, int64_t count, const ents_detection *detection, ents_report *report);

/* Self-contact: one surface is slave and master. How thick is the body below each slave? Since contract 1.11. A slave on one side of a thin
 * body is behind the other side as one that has penetrated another part of the surface is behind that. Where they lie cannot tell them
 * apart, and the thickness does: take half of it as detection.depth.
 *   model .. count   as of ents_detect; normal projection. The mesh as it is at the begin of an increment
 *   detection        slave, reach, slave_normal (needed) and what is left out: slave_node, slave_segment, sides. Not written
 *   thickness        [count] in: the thickness at the begin of the increment before, or 0 the first time; out: the distance of the
 *                    slave from the nearest point of the segments that it is behind and that lies below the tangent plane of its own
 *                    surface, at most 2 reach; segments count whose normal makes an angle of more than 104 degrees with the slave's. Nearer places than half the thickness of before (the first time: 1e-4 reach) are contact, not
 *                    the other side of the body
 * The first configuration must not overlap itself by more than 1e-4 reach: it would be taken for a thin body, and the overlap not be seen as contact.
 * No increment may halve the thickness, or turn a corner of the body by more than 16 degrees: its other side would be taken for contact.
 * Errors: those of ents_detect, with nothing written from the slave with the error on; BAD_VALUE for shadow projections. */
ENTS_API int32_t ents_thickness(const ents_model *model, const ents_master_mesh *mesh, const double *tree, int64_t size, int64_t first,
                                int64_t count, const ents_detection *detection, double *thickness, ents_report *report);

/* ---- evaluation ------------------------------------------------------------------------------- */

/* Inputs of contact elements: one slave node and one master segment each. The caller owns all arrays; the library only reads them.
 * `..._stride` is the distance between consecutive elements, in numbers of the array's type; 0 means that all elements share the
 * values (one segment for many slave nodes, say), see ENTS_SHARED_... A call that ends at element 0 (first = 0, count = 1) does not
 * read strides.
 * The first increment. Friction and wear of a slave that touches within an increment begin at the touch, which takes where it was at the
 * begin: before the first increment evaluate the elements once at its begin, with states of ents_state_init and ENTS_STATE; the states
 * that this returns are the increment's state_begin (ents_iterate: `slave_begin`). Without it such an element has no friction in that
 * increment, and ENTS_FLAG_NO_BEGIN; and what opens in the first increment has no bond (ENTS_NEEDS_FIRST_STATE). */
typedef struct ents_input {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  const double *slave;               /* [d] position, [L], finite */
  int64_t slave_stride;
  const double *master;              /* [m][d] positions, [L], finite */
  int64_t master_stride;
  const double *surface_coordinates; /* [m][d-1] s of each master node; null: the model's own, else s = xi */
  int64_t surface_coordinates_stride;
  const double *start;               /* [d-1] natural coordinates from which the projection starts; null: the whole segment is searched */
  int64_t start_stride;
  const double *area;                /* [1] tributary area of the slave node, [A], >= 0; null: 1. Without area there is no force, and
                                        multiplier dofs are held at zero */
  int64_t area_stride;
  const double *state_begin;         /* [state_size] begin of increment, read only; null: no history.
                                        The projection of a state in contact is used instead of `start` */
  int64_t state_begin_stride;
  const double *multiplier;          /* [multipliers] values of the multiplier dofs: lambda_n [F/A], then with friction
                                        lambda_a [F L/A], covariant in xi; required if the layout has any */
  int64_t multiplier_stride;
  const ents_master_mesh *mesh;      /* with `segment`: nodes and surface coordinates come from here instead of `master`
                                        and `surface_coordinates`, which are then null */
  const int64_t *segment;            /* [1] index of the segment in `mesh`, as ents_detect gives it; -1 (open) for ents_assemble alone.
                                        Not read without `mesh` */
  int64_t segment_stride;
  const double *positions_begin;     /* [nodes][d] positions of the mesh at the begin of the increment, [L]; ents_iterate alone reads
                                        them, to move states with friction to other segments. May be mesh.positions if the
                                        master does not deform, and null if the model says "master": "rigid". Since contract 1.5 */
  int64_t shared;                    /* ENTS_SHARED_... bits: arrays whose stride is 0, and states that are left out, on purpose; read by ents_assemble and ents_iterate.
                                        Since contract 1.5 */
  const double *slave_values;        /* [slave_values] numbers of this slave node: added to the model's "offset" [L]; factor of the wear coefficient, >= 0
                                        (0: does not wear); factor of the wear's "sliding", >= 0 (the distance from the axis where that
                                        is an angle); scale r > 0 of the table, whose pressure is r p(g/r), or factor of the work of adhesion.
                                        Null: 0, 1, 1, 1. For models with "offset", "wear", "table" or adhesion. Since contract 1.6; the
                                        scale and "table" since 1.7 */
  int64_t slave_values_stride;
  const double *slave_begin;         /* [elements][d] positions of the slave nodes at the begin of the increment, [L], or null; ents_iterate alone reads them,
                                        for ways (as detection.slave_begin, with positions_begin), and for states that are still those of ents_state_init, or of slaves that were not within reach:
                                        it evaluates these there first (in positions_begin), so that friction and wear of a slave that touches
                                        within the increment begin at the touch. Since contract 1.8 */
  const double *slave_temperature;   /* [1] of the slave node, for a model with "heat", finite; needed for residual, tangent and heat. Since contract
                                        1.10, as what follows */
  int64_t slave_temperature_stride;
  const double *master_temperature;  /* [m] of the master nodes, also of a rigid master; with `mesh` null: they come from mesh.temperature */
  int64_t master_temperature_stride;
  double time_increment;             /* of this increment, > 0, where the heat of friction, a power, is asked for, and (since 1.11) with a
                                        coefficient of friction that depends on the slip rate; else not read */
} ents_input;

/* Bits of ents_input.shared. With a stride of 0 all elements take the first one's value. In an assembly such a stride is usually a
 * forgotten one: ents_assemble and ents_iterate refuse it (BAD_COUNT) for these arrays, unless the array's bit is set. They do not refuse
 * it if the call ends at element 0, or if the caller's ents_input ends before `shared`; ents_evaluate never refuses it. */
#define ENTS_SHARED_SLAVE      (1 << 0)
#define ENTS_SHARED_SEGMENT    (1 << 1)
#define ENTS_SHARED_AREA       (1 << 2)
#define ENTS_SHARED_STATE      (1 << 3)  /* state_begin: one state of ents_state_init for all elements, say */
#define ENTS_SHARED_MULTIPLIER (1 << 4)
#define ENTS_SHARED_NO_STATE   (1 << 5)  /* state_begin is null although the law has a history (ENTS_NEEDS_HISTORY): it begins with this call.
                                            Without this bit ents_assemble and ents_iterate refuse that (since contract 1.6) */
#define ENTS_SHARED_SLAVE_VALUES (1 << 6) /* since contract 1.6 */
#define ENTS_SHARED_TEMPERATURE (1 << 7) /* slave_temperature: all slave nodes have one. Since contract 1.10 */

/* Bits of ents_output.wanted: which results to compute. Other results are not computed, and their arrays are not written. */
#define ENTS_XI            (1 << 0)  /* xi            [d-1]          natural coordinates of the projection */
#define ENTS_GAP           (1 << 1)  /* gap           [1]    [L]     along n_e (normal) or along the ray (shadow) */
#define ENTS_NORMAL_GAP    (1 << 2)  /* normal_gap    [1]    [L]     (x_s - rho_e) . n_e */
#define ENTS_NORMAL        (1 << 3)  /* normal        [d]            n_e, unit normal of the enriched surface */
#define ENTS_POINT         (1 << 4)  /* point         [d]    [L]     rho_e at the projection */
#define ENTS_GAP_GRADIENT  (1 << 5)  /* gap_gradient  [n]            dg/du,       eq. (3); n = d (m+1), or d for a rigid master, here and below. These
                                        four hold the scale of a height with "flattening" fixed */
#define ENTS_GAP_HESSIAN   (1 << 6)  /* gap_hessian   [n][n]         d2g/du2,     eq. (4); [1/L]. Follows the model's "tangent" key */
#define ENTS_XI_GRADIENT   (1 << 7)  /* xi_gradient   [d-1][n]       dxi/du,      eq. (3); [1/L] */
#define ENTS_XI_HESSIAN    (1 << 8)  /* xi_hessian    [d-1][n][n]    d2xi/du2, eq. (4); [1/L^2]. Always exact; needs C3 of h with normal projection */
#define ENTS_ENERGY        (1 << 9)  /* energy        [1]    [F L]   W */
#define ENTS_PRESSURE      (1 << 10) /* pressure      [1]    [F/A]   -dW/dg / area; > 0 in contact */
#define ENTS_RESIDUAL      (1 << 11) /* residual      [dofs] [F]     R = dW/du; of a temperature: the power that leaves the node */
#define ENTS_TANGENT       (1 << 12) /* tangent       [dofs][tangent_leading_dimension] [F/L]  K = dR/du */
#define ENTS_STATE         (1 << 13) /* state_end     [state_size]   must not overlap state_begin, but may lie between its blocks */
#define ENTS_FLAGS         (1 << 14) /* flags         [1] int32: ENTS_FLAG_... */
#define ENTS_ITERATIONS    (1 << 15) /* iterations    [1] int32: surface evaluations the projection took */
#define ENTS_TRACTION      (1 << 16) /* traction      [d]    [F/A]   tangential traction on the master, spatial vector */
#define ENTS_SLIP          (1 << 17) /* slip          [1]    [L]     accumulated slip of the state, end of increment */
#define ENTS_AGE           (1 << 18) /* age           [1]            increments since the last change of status */
#define ENTS_DISSIPATION   (1 << 19) /* dissipation   [1]    [F L]   what friction dissipates in this increment: the tangential force at its end times the slip
                                        (backward Euler), and what damage of a "cohesive" bond takes (since 1.11). Since contract 1.10, as what
                                        follows */
#define ENTS_FRICTION_ENERGY (1 << 20) /* friction_energy [1] [F L]  stored in the elastic slip of friction at the end; 0 where a multiplier has the force */
#define ENTS_HEAT          (1 << 21) /* heat          [2]    [power] through the gap, from the slave to the master; made by friction (share of dissipation /
                                        time_increment, both sides together) */

/* Bits of flags. If the model has "contact", they describe the contact element (in contact or open ...), whichever results are wanted. */
#define ENTS_FLAG_CONTACT  1   /* the element is closed: it carries pressure, or its gap is exactly that at which the law's contact begins (0) */
#define ENTS_FLAG_OUTSIDE  2   /* the projection lies outside the segment: open, R = 0, K = 0 */
#define ENTS_FLAG_FAR_SIDE 4   /* the slave node is beyond a centre of curvature: the projection is no minimum of the distance */
#define ENTS_FLAG_SEARCHED 8   /* the whole segment was searched */
#define ENTS_FLAG_STICK    16  /* friction: elastic */
#define ENTS_FLAG_SLIP     32  /* friction: |t| = limit; with a coefficient of 0 every element that was in contact before */
#define ENTS_FLAG_SHEAR_LIMIT 64 /* the limit is the model's shear_limit */
#define ENTS_FLAG_AMBIGUOUS 256 /* ents_detect: two projections are equally good, or it is not proved that they are not */
#define ENTS_FLAG_BEHIND_EDGE 512 /* ents_detect: the closest point is on an edge between segments and the slave node is behind it: it has
                                    penetrated, but has no segment */
#define ENTS_FLAG_LEFT 1024 /* ents_detect: a slave node in contact has left all segments beside a free edge, or is deeper than `reach` */
#define ENTS_FLAG_NO_BEGIN 2048 /* in contact, but where the slave node was at the begin of the increment is not known (no state, that of
                                   ents_state_init, or one of another segment), or the law's multipliers are unknowns: no friction in this increment. Since contract 1.8 */
#define ENTS_FLAG_CROSSED 4096 /* in ents_detection.permitted: slaves may pass through the surface within an increment */
#define ENTS_FLAG_CHANGED  128 /* the element was open, sticking or slipping at the begin of the increment and is not now; a new state is open */

/* Outputs. The caller owns all arrays; the library writes those whose bit is set in `wanted`, and the others may be null. A stride is the
 * distance between consecutive elements, in numbers of the array's type, and at least the size of one element (else BAD_COUNT). A
 * call that ends at element 0 (first = 0, count = 1) does not read strides. Outputs must not overlap each other or inputs, with one
 * exception: xi may be input.start (the same pointer and stride). */
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
  double *dissipation;   int64_t dissipation_stride;
  double *friction_energy; int64_t friction_energy_stride;
  double *heat;          int64_t heat_stride;
} ents_output;

/* Evaluate the elements first .. first + count - 1 of the arrays. n elements give the same bits as n calls of one element each.
 *   model         any model; bits that need a contact law (ENTS_ENERGY .. ENTS_TANGENT, ENTS_TRACTION ...) need "contact" in its text
 *   first, count  range of elements, >= 0; a host's threads may take ranges of the same arrays
 *   input         positions, areas and states, all finite
 *   output        which results to compute, and where to write them
 * Kinematic results (ENTS_XI .. ENTS_XI_HESSIAN) alone do not see the border of the segment: xi may lie outside. An element whose slave
 * node is so far beside the segment that no projection exists is open (ENTS_FLAG_OUTSIDE); its xi, gap, normal and point are those of
 * the last iterate.
 * Patches. A model with a "patch" has elements of several segments, for hosts whose elements have fixed nodes. m is then the number of
 * the patch's nodes, and `start` is not used. The segment is chosen as ents_detect chooses it: a slave node in contact is followed from
 * `state_begin` on, an open one is searched in all segments. xi and its variations are those of the chosen segment. In the increment in
 * which a slave node with friction changes its segment, its anchor moves to the new segment in the current positions. The tangent leaves
 * out how the moved anchor depends on these positions (up to a third of its largest entry; nothing with "surface_coordinates" or a
 * rigid master). A slave node behind a concave edge is NO_PROJECTION. ents_surface_evaluate, ents_model_check and the functions of
 * whole surfaces take the segments of such a model one by one.
 * Returns 0; or the first negative status, then results of elements before that one are written; or, when all elements have been
 * evaluated, the recoverable status of the first element that has one. */
ENTS_API int32_t ents_evaluate(const ents_model *model, int64_t first, int64_t count,
                               const ents_input *input, const ents_output *output,
                               ents_report *report);

/* Fill state blocks for elements without history.
 *   count   number of blocks, >= 0
 *   state   [count] blocks of state_size doubles, out
 *   stride  distance between blocks in doubles, >= state_size
 * A state block knows the segment type and the kinds of normal law and friction of the model that wrote it; a model with others refuses
 * it (BAD_STATE). It does not know the height or the numbers of the law: another model of the same kinds goes on with it (heights that
 * wear between increments). A state that was written with ents_input.mesh also knows the number of its segment. With friction, an
 * element on another segment then refuses it, unless ents_iterate moves it, or ents_state_transfer has moved it. */
ENTS_API int32_t ents_state_init(const ents_model *model, int64_t count, double *state,
                                 int64_t stride, ents_report *report);

/* Augmented Lagrangian with multipliers in the state (Uzawa's iteration). After a converged solve, this call copies the multipliers of the
 * states of the end into the states of the begin; the host then solves the same increment again, until penetration and slip are
 * small. Nothing else in `state_begin` changes: it is still the begin of the increment.
 *   count         number of blocks, >= 0
 *   state_begin   [count] blocks, in and out; begin_stride >= state_size
 *   state_end     [count] blocks; end_stride >= state_size
 * Errors: BAD_STATE if the model keeps no multipliers in the state, or a block is not a state of this model. */
ENTS_API int32_t ents_state_augment(const ents_model *model, int64_t count, double *state_begin, int64_t begin_stride,
                                    const double *state_end, int64_t end_stride, ents_report *report);

/* Move a state to another segment, for a slave node that has moved there. (ents_iterate does this itself.) The anchor of friction and
 * the multipliers keep their place on the material of the master surface, so that no slip is lost. Their place on the new segment is the
 * point with the same surface coordinates, if both arrays of surface coordinates are given and lead to the same point of space (they
 * do not over a seam, or if they are constant along the segment); otherwise the closest point of the new segment, extended
 * beyond its border.
 *   old_master, new_master  [m][d] positions, [L], both at the same time: the begin of the increment
 *   old_..., new_surface_coordinates  [m][d-1]; null: those of the model, or s = xi if it has none (positions decide then)
 *   state, moved            [state_size] in, out; may not overlap
 * Recoverable: NO_PROJECTION (of the anchor: open slaves and models without friction have none), DEGENERATE_SEGMENT. */
ENTS_API int32_t ents_state_transfer(const ents_model *model, const double *old_master, const double *old_surface_coordinates,
                                     const double *new_master, const double *new_surface_coordinates,
                                     const double *state, double *moved, ents_report *report);

/* Wear. A model with "wear" in its "contact" loses k p ds of height per increment (Archard), within the element: see the key. What the
 * slave surface has lost stays in the states of its points, or ents_wear_collect_slave moves it. What the master surface has lost is there,
 * too, until this call moves it into a field, for the place where it was lost: once per increment, for the states of the converged end
 * (not for a step that is cut).
 * The field loses exactly the volume depth x area of all elements, spread over the B-splines around each point.
 *   model         with wear, bound to the field
 *   first, count  range of elements, >= 0
 *   input         as of ents_evaluate: slave, areas, and the segments on which the states were made; state_begin has to be null
 *   thickness     2D: of the bodies, as in the areas, [L], > 0; axisymmetric bodies: 0; 3D: not read
 *   state         [elements] in and out: their lost depth of the master becomes zero
 *   state_stride  >= state_size
 *   name          of the field, zero-terminated
 *   block, size   in and out: the field of ents_field_init. Bind it again afterwards
 *   volume        out or null: what the field has lost in this call, [L^3]
 * Errors: those of ents_evaluate and ents_field_sample; BAD_STATE also for a state of another segment than the input's, BAD_VALUE for a model
 * with a "patch". All elements are checked before the field changes. */
ENTS_API int32_t ents_wear_collect(const ents_model *model, int64_t first, int64_t count, const ents_input *input, double thickness,
                                   double *state, int64_t state_stride, const char *name, double *block, int64_t size, double *volume,
                                   ents_report *report);

/* Derivatives by the named parameters of the model, at fixed positions and states. Each array may be null. */
typedef struct ents_derivatives {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  double *gap;                       /* [elements][named_parameters] dg/dtheta */
  double *energy;                    /* [elements][named_parameters] dW/dtheta, times area */
  double *residual;                  /* [elements][named_parameters][dofs] dR/dtheta */
  const double *adjoint;             /* [elements][dofs] lambda; needed for `product` */
  double *product;                   /* [named_parameters] lambda . dR/dtheta of all elements is added, one after the other */
} ents_derivatives;

/* Derivatives of gap, energy and residual of the elements first .. first + count - 1 by every named parameter.
 *   input        as of ents_evaluate
 *   derivatives  arrays of elements 0 .. first + count - 1, one element behind the other
 * With the tangent K and the derivatives dR/dtheta of a converged solution, du/dtheta = - K^-1 dR/dtheta; with an adjoint K^T lambda = df/du,
 * df/dtheta = - lambda . dR/dtheta. Models with multiplier dofs and patches are refused (BAD_VALUE). Statuses: as ents_evaluate;
 * an open element has zeros. */
ENTS_API int32_t ents_parameter_derivatives(const ents_model *model, int64_t first, int64_t count, const ents_input *input,
                                            const ents_derivatives *derivatives, ents_report *report);

/* Tributary areas of slave nodes: of each facet, the part of its area that belongs to each node (row sums for linear
 * facets; lumped in proportion to the integral of N_i^2 for quadratic ones, so that all are positive).
 *   facet         "line2", "line3", "tri3", "tri6", "quad4", "quad8", "quad9"
 *   connectivity  [facets][nodes of the facet], 0 <= index < nodes
 *   positions     [nodes][d], [L]
 *   thickness     2D: the area of a length, [L]; axisymmetric bodies: 0, the areas are then of the full turn about the second axis. 3D: ignored
 *   areas         [nodes] out, [A]; 0 for nodes on no facet
 * With quad8 and tri6 nodes do not carry a uniform pressure: its exact shares are negative in the corners of quad8 (-1/12 of the area of a
 * rectangle) and 0 in those of tri6, the lumped areas are positive (3/76 and 1/19). A body under a uniform pressure then lifts off at some
 * nodes and presses more on others (a hex20 block: 0 to 1.23 for 1). Put slave points inside such facets (ents_sampling_points, 2 or 3 per
 * direction), which give every node its exact share. On line3 and quad9 the lumped areas are the exact shares.
 * Allocates (NO_MEMORY). Errors: NULL_ARGUMENT, BAD_COUNT, BAD_VALUE (a facet or node that does not exist, report.element; a thickness
 * that is not >= 0), NON_FINITE. Recoverable: DEGENERATE_SEGMENT (a facet without area, report.element). After any of them nothing is written. */
ENTS_API int32_t ents_tributary_areas(const char *facet, int64_t facets, const int64_t *connectivity, int64_t nodes,
                                      const double *positions, double thickness, double *areas, ents_report *report);

/* Area in contact and peak pressure on a slave mesh, with estimates of what the mesh leaves open. The tributary areas of
 * closed nodes are too large together: a node closes as soon as a part of its area is in contact. */
typedef struct ents_area {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  double surface;                    /* of all facets, [A] */
  double counted;                    /* tributary areas of the closed nodes, [A] */
  double border_corrected;           /* counted - (pi - 1 + ln 2) / 24 * spacing * length of the border of contact, [A] (V. A. Yastrebov,
                                        G. Anciaux, J.-F. Molinari, Tribol. Int. 114, 2017); lines: counted */
  double zero_line;                  /* facets cut where pressure and gap at the ends of their edges say that contact ends, [A]; 0
                                        without a modulus */
  double estimate;                   /* [A] the mean of the two (lines: zero_line); without a modulus border_corrected */
  double error;                      /* bound of its error, [A]: what the two differ by, or half of what they change, and the scatter of
                                        a count of nodes. Roughness between the nodes is not known and not in it */
  double peak_pressure;              /* largest nodal pressure, [F/L^2] */
  double peak_drop;                  /* peak_pressure minus the mean pressure of the neighbouring nodes, [F/L^2]: from a third of the
                                        peak on the mesh does not resolve it, and the true peak may be twice as high */
} ents_area;

/* Contact area of a slave surface from the results at its nodes. Near the border of contact the pressure is k sqrt(s) inside and
 * the gap 4 k s^(3/2) / (3 modulus) outside, s the distance from it (K. L. Johnson, Contact Mechanics, 1985): that gives the place
 * where contact ends on every edge between a closed node (pressure > 0) and an open one.
 *   facet         "line2", "tri3", "quad4"
 *   connectivity  [facets][nodes of the facet], 0 <= index < nodes
 *   positions     [nodes][d], [L]
 *   thickness     as of ents_tributary_areas
 *   gap           [nodes] [L]; read at open nodes only; NaN or infinite: nothing is opposite
 *   pressure      [nodes] [F/L^2], finite; a node is closed where it is > 0
 *   modulus       E / (1 - nu^2) against a rigid master, of two bodies 1 / (1/modulus_1 + 1/modulus_2), [F/L^2]; 0: not known
 *   area          out; zero it and set its struct_size
 * Allocates (NO_MEMORY). Errors: NULL_ARGUMENT, STRUCT_SIZE, BAD_COUNT, BAD_VALUE (another facet; a node that does not exist,
 * report.element; a thickness or modulus that is not >= 0), NON_FINITE. Recoverable: DEGENERATE_SEGMENT (a facet without area,
 * report.element). After any of them nothing is written. */
ENTS_API int32_t ents_contact_area(const char *facet, int64_t facets, const int64_t *connectivity, int64_t nodes,
                                   const double *positions, double thickness, const double *gap, const double *pressure,
                                   double modulus, ents_area *area, ents_report *report);

/* What a pair of surfaces carries together, as it acts on the slave side. */
typedef struct ents_resultants {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  double normal[3];                  /* [d] sum of p A n_e, [F] */
  double tangential[3];              /* [d] sum of - A traction, [F] */
  double moment[3];                  /* about `about`, [F L]; 2D: the first one alone, about the axis out of the plane */
  double centre[3];                  /* [d] centre of pressure: mean of the points, weighted with p A, [L]; `about` where nothing presses */
  double area;                       /* areas of the points in contact, [A]: too large together, see ents_contact_area */
  double largest_pressure;           /* [F/A] */
  int64_t deepest;                   /* the point that has it, -1: none */
  int64_t open, contact, stick, slip; /* points; those that stick or slip are among those in contact */
} ents_resultants;

/* Resultants from the results of ents_evaluate or ents_iterate: forces, moment, area, centre of pressure, and how many points do what.
 *   dimension  2 or 3
 *   count      number of points, >= 0
 *   points     [count][d] where the slave points are, [L]
 *   normal     [count][d] of ENTS_NORMAL; not read at points that carry no pressure
 *   pressure   [count] of ENTS_PRESSURE, [F/A]
 *   traction   [count][d] of ENTS_TRACTION, on the master, or null: no friction
 *   areas      [count] [A]
 *   flags      [count] of ENTS_FLAGS
 *   about      [d] point of the moment, [L]; null: the origin
 *   resultants out; zero it and set its struct_size
 * The forces are those of pressure and traction; where a penetration is not small beside the radius of the surface, friction on the slave
 * is larger than the traction on the master (theory.md, section 5.9), and sums of residuals are exact.
 * Errors: NULL_ARGUMENT, STRUCT_SIZE, BAD_COUNT, BAD_VALUE (dimension), NON_FINITE (the message names array and point). Since contract 1.10. */
ENTS_API int32_t ents_contact_resultants(int32_t dimension, int64_t count, const double *points, const double *normal,
                                         const double *pressure, const double *traction, const double *areas, const int32_t *flags,
                                         const double *about, ents_resultants *resultants, ents_report *report);

/* Numbers to begin with. */
typedef struct ents_suggestion {
  int32_t struct_size;
  int32_t reserved;                  /* 0 */
  double normal_stiffness;           /* of the penalty, [F/L^3]: 30 modulus / spacing. Residual penetrations are then about 1 % of the deformation over
                                        one spacing, and Newton's iteration still converges: see "Penalty" in abi/README.md */
  double tangential_stiffness;       /* of friction, [F/L^3]: the same */
  double time_step;                  /* of central differences that a slave node and what it presses on stay below with this stiffness: 2 / omega,
                                        omega^2 = stiffness area (1 / slave_mass + 1 / master_mass); 0 without a mass. The bodies have limits of their own */
} ents_suggestion;

/* Stiffness of a penalty from the bodies and the mesh, and the critical time step of an explicit host.
 *   modulus      Young's modulus of the softer body, [F/L^2], > 0
 *   spacing      distance of the slave points, [L], > 0
 *   area         tributary area of a slave point, [A]; only read with masses
 *   slave_mass, master_mass  of a slave point, and of the master there (1 / sum of N_i^2 / m_i), [F T^2 / L]; 0: slave: no time step is asked for; master: rigid
 *   suggestion   out; zero it and set its struct_size
 * Errors: NULL_ARGUMENT, STRUCT_SIZE, NON_FINITE, BAD_VALUE (the message names the argument). Since contract 1.10. */
ENTS_API int32_t ents_suggest(double modulus, double spacing, double area, double slave_mass, double master_mass,
                              ents_suggestion *suggestion, ents_report *report);

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
  const int32_t *reflected;          /* [begin[points]] or null: bits 1, 2, 4: X[nodes[j]] counts with its component x, y, z
                                        reversed, as the image of the node in a plane normal to that axis. Since contract 1.8 */
  const double *shifts;              /* [points][d] or null: added to x_i, [L]. Since contract 1.8 */
  const double *heights;             /* [points] or null: x_i is raised by so much along the unit normal of its facet, which turns with the
                                        facet's nodes, [L]: see ents_raise_points. Since contract 1.11 */
  const double *slopes;              /* [begin[points]][d-1] derivatives of the weights by the facet's natural coordinates; needed with
                                        heights, which `reflected` and the points of a master do not have. Since contract 1.11 */
} ents_combination;

/* Positions of the points from those of the host's nodes; or any other numbers that are given per node (surface coordinates);
 * with `reflected`, `shifts` or `heights` these are positions, and surface coordinates are components of the points.
 *   dimension  numbers per node: 1, 2 or 3
 *   positions  [nodes][d] of the host's nodes, [L], finite
 *   points     [points][d] out */
ENTS_API int32_t ents_combine(const ents_combination *combination, int32_t dimension, int64_t nodes, const double *positions,
                              double *points, ents_report *report);

/* Sampling points of slave facets, so that texture between slave nodes is seen and a constant pressure gives every
 * slave node its exact share (Zavarise and De Lorenzis, IJNME 79, 2009). Arguments as of ents_tributary_areas, and
 *   per_direction  n, 1 .. 64, of quadratic facets 2 or more: lines have n points, triangles and quadrilaterals n^2. Lines and
 *                  quadrilaterals: Gauss and Legendre's; tri3, and quad4 with two nodes in one place: the centroids of n^2 equal parts;
 *                  tri6: those, farther from the middle by n / sqrt(n^2 - 1), exact for its shape functions; n = 1 on an axisymmetric
 *                  line2: the centroid of the ring
 *   begin          [points + 1] out, points = facets * points of a facet, those of a facet one after the other
 *   point_nodes    [points * nodes of the facet] out
 *   weights        [points * nodes of the facet] out
 *   areas          [points] out, [A]
 * begin, point_nodes and weights make an ents_combination. Allocates (NO_MEMORY). Statuses: those of ents_tributary_areas, DEGENERATE_SEGMENT
 * among them, and nothing is written after any of them. */
ENTS_API int32_t ents_sampling_points(const char *facet, int32_t per_direction, int64_t facets, const int64_t *connectivity,
                                      int64_t nodes, const double *positions, double thickness, int64_t *begin,
                                      int64_t *point_nodes, double *weights, double *areas, ents_report *report);

/* A slave surface that is enriched, too: its points are x = sum N_i X_i + h n, n the unit normal of the slave facet. h is that of the point,
 * for its surface coordinates do not change; n turns with the nodes of the facet, and so x is no linear combination of them. ents_combine
 * gives x, and ents_assemble and ents_iterate put residual and tangent on the nodes with the exact first and second derivatives of x: the
 * tangent stays symmetric without friction, forces and moments of both sides balance.
 *   surface      a model whose "height" is that of the slave's facets (a bound one, if it has parameters or fields). All else in it but d is
 *                not read: any segment of the same dimension will do. The slave's normal points out of its body, as a master's does
 *   points       the points inside their facets, as ents_sampling_points makes them: each over the 2 or 3 nodes of a line, 3, 4, 6, 8 or 9
 *                of a face, with the facet's shape functions as weights. Its heights and slopes are not read
 *   coordinates  [begin[points]][d-1] surface coordinates of the nodes of each point's facet; null: natural coordinates of the facet
 *   heights      [points] out, [L]
 *   slopes       [begin[points]][d-1] out
 * Put both into the combination, and the current positions of the nodes into ents_system.slave_positions.
 * Wear: what the state has as depth lost by the slave stays there, or ents_wear_collect_slave moves it into the height.
 * Errors: those of a combination; NULL_ARGUMENT; NON_FINITE (a coordinate, or a height that is not defined there); BAD_VALUE (weights that are
 * no shape functions of a facet, as those of slave nodes: report.element is the point). Since contract 1.11. */
ENTS_API int32_t ents_raise_points(const ents_model *surface, const ents_combination *points, const double *coordinates, double *heights,
                                   double *slopes, ents_report *report);

/* Wear of a slave surface whose points lie above their facets by a height that has a field, as ents_wear_collect for the master: what the
 * slave has lost goes from the states into that field, and lowers the slave's height along the normals of its own facets. Once per increment, for
 * the states of the converged end, before or after ents_wear_collect; then bind the field and call ents_raise_points again. Without this call
 * the depth stays in the states and opens the gap along the normal of the master. The field loses exactly the volume depth x area.
 *   model         with wear
 *   surface       of the slave's height, as of ents_raise_points, with the field; may be bound or not
 *   points        as of ents_raise_points
 *   coordinates   as of ents_raise_points; null for points of one facet alone, for facets in natural coordinates share one height
 *   nodes         number of nodes
 *   positions     [nodes][d] of the nodes for which the areas are given, [L], finite
 *   thickness     as of ents_wear_collect
 *   areas         [points] as in the elements, [A]
 *   state         [points] in and out: their depth lost by the slave becomes zero
 *   state_stride  >= state_size
 *   name          of the field of `surface`, zero-terminated
 *   block, size   in and out: the field of ents_field_init
 *   volume        out or null: what the field has lost in this call, [L^3]
 * Errors: those of ents_raise_points and ents_field_sample; BAD_VALUE: a model without wear, coordinates that are missing; BAD_STATE.
 * Positive statuses: DEGENERATE_SEGMENT (a facet without area, report.element is the point), OUT_OF_RANGE (areas or coordinates beyond all
 * bounds). All points are checked before the field changes. Since contract 1.11. */
ENTS_API int32_t ents_wear_collect_slave(const ents_model *model, const ents_model *surface, const ents_combination *points,
                                         const double *coordinates, int64_t nodes, const double *positions, double thickness,
                                         const double *areas, double *state, int64_t state_stride, const char *name, double *block,
                                         int64_t size, double *volume, ents_report *report);

/* What stands beyond a free end or border, x_0 on it, x_1, x_2, x_3 the nodes inside; and what the control points are. */
#define ENTS_ENDS_STRAIGHT 0        /* 2 x_0 - x_1; control points are the nodes */
#define ENTS_ENDS_REPEATED 1        /* x_0 once more; control points are the nodes */
#define ENTS_ENDS_QUASI_CUBIC 2     /* quasi-interpolation, 4 x_0 - 6 x_1 + 4 x_2 - x_3. Since contract 1.8 */
#define ENTS_ENDS_QUASI_PARABOLIC 3 /* quasi-interpolation, 3 x_0 - 3 x_1 + x_2. Since contract 1.8 */

/* A smoothed master surface over ordinary facets: one segment of a smoothed basis per facet, in the same order and with the
 * same natural coordinates, and control points that are linear combinations of the host's nodes. It follows from the connectivity
 * alone: make it once. From then on a surface is
 *   mesh.connectivity = segment_points, mesh.nodes = points, mesh.positions = ents_combine(positions of the nodes),
 * and ents_assemble, with the combination in system.master, adds residual and tangent to the equations of the host's own nodes.
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
 * Quasi-interpolation (C. de Boor and G. Fix, J. Approx. Theory 8, 1973; bspline4 and bspline16): control points are (-1, 8, -1) / 6 of
 * three nodes, in 3D in both directions, so that the spline follows the nodes: its distance from a smooth surface on which they lie is
 * O(size of the facets ^ 4), with ENTS_ENDS_QUASI_PARABOLIC O(size ^ 3) in the two facets at a free end. With control points at the nodes
 * it is O(size ^ 2). Continuity is as above. The spline ends in x_0, regular borders are the splines of their nodes, what is plane stays
 * plane. At a free end an order of 4 and a passed patch test exclude each other: a uniform pressure on matching meshes arrives
 * with the nodal forces of the plain facets under ENTS_ENDS_QUASI_PARABOLIC, and with errors up to 8 % under ENTS_ENDS_QUASI_CUBIC
 * (core/README.md has the numbers). Extraordinary nodes: 2 x less the limit point of control points at the nodes; there the distance
 * is O(size ^ 2) with a smaller factor. Lines of fewer facets than the rule of their end needs take the lower one.
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

/* Planes of symmetry on which a surface ends. Since contract 1.8. */
typedef struct ents_mirror {
  int32_t struct_size;
  int32_t planes;                    /* 0 .. 6 */
  const int32_t *axes;               /* [planes] the axis that is normal to each: 0 (x), 1 (y) or 2 (z) */
  const double *places;              /* [planes] where the planes cut these axes, [L], finite */
  const double *positions;           /* [nodes][d] undeformed positions of the host's nodes, [L], finite */
} ents_mirror;

/* As ents_smooth, for a surface that ends on planes of symmetry: it goes on beyond them as its mirror image, so that the surface
 * of a half is that of the whole, with its continuity and accuracy, and a uniform pressure passes the plane exactly. Nodes are on a
 * plane that are nearer to it than 1e-9 of the surface's extent; the host holds them there. Images are terms of the points with
 * `reflected` and `shifts`, which go into the ents_combination with begin, point_nodes and weights: positions, forces and tangent
 * of the images are those of their nodes. Since contract 1.8.
 *   facet ... nodes      as of ents_smooth; `ends` is for borders that are on no plane
 *   mirror               planes = 0: as ents_smooth
 *   points, terms        sizes of what ents_smooth_mirrored fills: ents_smooth_mirrored_size gives them
 *   segment_points ... weights  as of ents_smooth, of the facets themselves, not of their images
 *   reflected            [terms] out
 *   shifts               [points][d] out
 * Errors: those of ents_smooth; NULL_ARGUMENT, STRUCT_SIZE, BAD_COUNT (planes), BAD_VALUE: an axis outside 0 ... d - 1, a plane without
 * nodes or with nodes on both sides; NON_FINITE. */
ENTS_API int32_t ents_smooth_mirrored_size(const char *facet, const char *basis, int32_t ends, int64_t facets,
                                           const int64_t *connectivity, int64_t nodes, const ents_mirror *mirror,
                                           int64_t *points, int64_t *terms, ents_report *report);
ENTS_API int32_t ents_smooth_mirrored(const char *facet, const char *basis, int32_t ends, int64_t facets,
                                      const int64_t *connectivity, int64_t nodes, const ents_mirror *mirror, int64_t points,
                                      int64_t terms, int64_t *segment_points, int64_t *begin, int64_t *point_nodes,
                                      double *weights, int32_t *reflected, double *shifts, ents_report *report);

/* ---- a rigid master with a reference point ------------------------------------------------------
 *
 * A rigid body that moves and turns is a change of frame: the master's nodes stay where they are in the frame of the body, the slave
 * points are seen from there, and forces are turned back (frame indifference; spatial spin: Simo and Vu-Quoc, Comput. Methods Appl. Mech.
 * Eng. 58, 1986). The model says "master": "rigid"; mesh, tree, states and heights never change, for any number of turns. A host
 *   1. makes a pose (ents_pose_init), and moves it as its unknowns or its program want (ents_pose_move);
 *   2. takes the slave points into the body's frame (ents_pose_to_body) before ents_detect, ents_evaluate, ents_assemble, ents_iterate;
 *   3. gives the pose with the system (ents_system.pose, body_equations), or makes the element of slave and body itself
 *      (ents_pose_element). Normals, tractions and points that are results come back with ents_pose_to_space.
 * Not with multipliers as unknowns. Since contract 1.6. */
typedef struct ents_pose {
  int32_t struct_size;
  int32_t reserved;       /* 0 */
  double point[3];        /* [d] the reference point in space, [L] */
  double turn[9];         /* [d][d] row by row: Q, whose columns are the body's axes in space; x = point + Q y */
} ents_pose;

/* The body's frame is that of space, the reference point its origin.
 *   dimension  2 or 3
 *   pose       struct_size is set by the caller; the rest is written
 * Errors: BAD_VALUE (dimension). */
ENTS_API int32_t ents_pose_init(int32_t dimension, ents_pose *pose, ents_report *report);

/* Move the reference point and turn the body about it: point += translation, Q <- exp([spin]x) Q, kept orthonormal: no drift, whatever the
 * number of moves.
 *   translation  [d] [L], in space; null: none
 *   spin         [3] rotation vector in space, 2D [1] angle, radians, each at most 1e6; null: none. Turns about one axis add up in
 *                any number of steps
 * Errors: NON_FINITE; BAD_VALUE (a spin); BAD_STATE if Q is not orthonormal, or a reflection. Nothing is written then. */
ENTS_API int32_t ents_pose_move(int32_t dimension, const double *translation, const double *spin, ents_pose *pose,
                                ents_report *report);

/* y = Q^T (x - point), positions; v = Q w, vectors. The arrays [count][d] may be the same. Errors: BAD_COUNT, NON_FINITE (pose). */
ENTS_API int32_t ents_pose_to_body(int32_t dimension, const ents_pose *pose, int64_t count, const double *positions, double *in_body,
                                   ents_report *report);
ENTS_API int32_t ents_pose_to_space(int32_t dimension, const ents_pose *pose, int64_t count, const double *in_body, double *vectors,
                                    ents_report *report);

/* The element of a slave point and the body, from that of a rigid master in the body's frame.
 *   slave              [d] position in the body's frame
 *   residual, tangent  [d], [d][d] of ents_evaluate there; tangent: null with body_tangent
 *   body_residual      [n], n = 2d + (2D: 1, 3D: 3): on the slave point, on the reference point, moment about it [F L]
 *   body_tangent       [n][n] column-major or null: derivatives by the slave's displacement, the reference point's, and the spatial spin.
 *                      Without friction symmetric but for the block of the spin, whose skew part is -[moment]x / 2: finite rotations do
 *                      not commute
 * Errors: NULL_ARGUMENT, NON_FINITE (pose). */
ENTS_API int32_t ents_pose_element(int32_t dimension, const ents_pose *pose, const double *slave, const double *residual,
                                   const double *tangent, double *body_residual, double *body_tangent, ents_report *report);

/* The host's equations: rows of the dofs, right-hand side, and matrix in compressed rows. Rows and columns are counted from 0. The caller
 * owns all arrays; residual, values and places are written. */
typedef struct ents_system {
  int32_t struct_size;
  int32_t index_size;                /* 4 or 8: bytes of an index in row_begin and columns */
  const ents_combination *slave;     /* slave points over the host's nodes; null: slave point i is node i */
  const ents_combination *master;    /* nodes of the mesh (control points) over the host's nodes; null: node i is node i */
  int64_t slave_nodes;               /* nodes of the host that slave_equations covers */
  const int64_t *slave_equations;    /* [slave_nodes][node_dofs] row of each dof; -1: prescribed, left out */
  int64_t master_nodes;
  const int64_t *master_equations;   /* [master_nodes][node_dofs]; not read for a rigid master. May be slave_equations */
  const int64_t *multiplier_equations; /* [elements][multipliers]; needed if the layout has any */
  int64_t rows;
  double *residual;                  /* [rows] R is added; null: not wanted */
  const void *row_begin;             /* [rows + 1] compressed rows, counted from 0: the first is 0 */
  const void *columns;               /* [row_begin[rows]] ascending in each row */
  double *values;                    /* [row_begin[rows]] K is added; null: not wanted */
  int64_t *places;                   /* [elements][places_size] or null: the library remembers here where the entries of each element
                                        are in `values`, and adds faster the next time. Set all to 0 before the first call, and
                                        whenever row_begin or columns change. If an element gets another segment, other nodes
                                        or other equations, the library finds its places again by itself */
  int64_t places_size;               /* at least node_dofs (m+1)^2 + 1 (rigid: node_dofs + 1); not used with a `slave` or `master` combination or a pose */
  const ents_pose *pose;             /* of a rigid master that moves, or null: input.slave is in its frame. Since contract 1.6 */
  const int64_t *body_equations;     /* [2D: 3, 3D: 6] rows of the reference point's displacement and of the spin; -1: prescribed, left out */
  const double *slave_positions;     /* [slave_nodes][d] current positions of the host's nodes, [L], where `slave` has heights: input.slave is
                                        made of them by ents_combine; else not read. Since contract 1.11 */
} ents_system;

/* Evaluate the elements first .. first + count - 1 and add their residuals and tangents to the host's equations.
 *   model         any model with "contact"
 *   first, count  range of elements, >= 0. Ranges of one system may be added at the same time only if they have no row in common;
 *                 within a call elements are added in their order
 *   input         as of ents_evaluate. The segments come from input.mesh and input.segment, as ents_detect gives them; strides of 0
 *                 have to be named in input.shared
 *   output        other results per element as of ents_evaluate, without ENTS_RESIDUAL and ENTS_TANGENT; or null
 *   system        the host's equations
 * An element with segment -1 is open: its flags are ENTS_FLAG_OUTSIDE, its state is that of ents_state_init with the worn depths of
 * before, its other results are zero.
 * Its inputs are checked as those of all others, except `start`, which is not read. Open elements add nothing but the equations
 * "multiplier = 0": R = -A/eps lambda, K = -A/eps. If no results per element are wanted, elements that are clearly open are not
 * projected (the slave node is above the whole line2 or tri3 by more than its greatest height, or above a whole plain quad4).
 * Errors: those of ents_evaluate; BAD_PATTERN names the row and column that the pattern lacks. After an error or a
 * recoverable status `system` holds a part of the sum: set residual and values to their values before the call. */
ENTS_API int32_t ents_assemble(const ents_model *model, int64_t first, int64_t count, const ents_input *input,
                               const ents_output *output, const ents_system *system, ents_report *report);

/* Contact of one Newton iteration in one call: ents_detect, then ents_assemble with the segments found.
 *   model, mesh, tree, size, first, count, detection   as of ents_detect
 *   input    areas, states, multipliers and positions_begin. Its slave, master, surface_coordinates, mesh, segment and start must be
 *            null: the detection gives them, `start` even where input.state_begin has a projection
 *   output   as of ents_assemble; without `system` as of ents_evaluate
 *   system   as of ents_assemble; null: results per element only
 * Friction. If the state in input.state_begin is in contact on another segment than the one found, the call moves a copy of the state
 * to that segment, as ents_state_transfer does, in input.positions_begin. ents_assemble and ents_iterate write states that know their
 * segments; a state that knows none is taken as one of the segment found. input.state_begin does not change: it is the begin of the
 * increment in all iterations.
 * Lost contact. A slave whose contact is lost (see ents_detect) ends the call with NO_PROJECTION, unless detection.permitted has its flag:
 * ENTS_FLAG_BEHIND_EDGE even if the slave had no segment; ENTS_FLAG_LEFT even if only its state is in contact. The detection is then
 * complete, and no element has been evaluated.
 * All arguments are checked before anything is written, except the numbers of single slaves and elements.
 * Errors: those of ents_detect and ents_assemble; NULL_ARGUMENT if positions_begin is needed and null. Recoverable: those of
 * ents_assemble and ents_state_transfer, as status of the element. */
ENTS_API int32_t ents_iterate(const ents_model *model, const ents_master_mesh *mesh, const double *tree, int64_t size, int64_t first,
                              int64_t count, const ents_detection *detection, const ents_input *input, const ents_output *output,
                              const ents_system *system, ents_report *report);

/* ---- the enriched surface itself --------------------------------------------------------------- */

/* Points of one enriched segment, for pictures, meshes and checks. Results whose pointer is null are not computed. If a point is refused,
 * report.element is its number, and the points before it are written. */
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

/* Conditions of a whole surface (sections 2 and 3 and Fig. 4 of the paper): name, index in the arrays below, and the bound that the
 * worst value must keep. They are measured on grids of samples: features smaller than the distance of the samples may be missed. */
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
 *   judged       bit 1 << ENTS_CHECK_...: the model, the surface or the caller sets a bound; without, the value is for information only
 *   violated     the same: the value is beyond its bound. Bounds of 0 [L] leave room for rounding, see `bound`
 *   projection   normal projection only. Points beside a kink between two segments always have two projections and do not count.
 *                Without a reach: the smallest radius of curvature of rho_e alone
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

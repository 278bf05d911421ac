// Passes of the solver over a grid on a GPU. What they compute: see protocol.py, whose names they have, and splines.py.
//
// ITERATE is the type of pressures p, deflections u and heights h, VECTOR that of corrections. A vector over a free set is an array over the
// grid that is zero outside it; ``inside`` says which points are in. Sums are of double precision; each block of threads leaves its own in
// ``partial`` (columns, blocks), and the host adds them up in order, so that equal calls give equal numbers.
//
// Compiled as C++ with EMULATED, blocks have one thread: so they are tested where there is no GPU.

typedef ITERATE real;
typedef VECTOR scalar;
typedef long long whole;  // as the host passes whole numbers
typedef unsigned place;   // of a point: divisions take far longer with 64 bits
typedef unsigned char flag;

#ifdef EMULATED
#define LANES 1
#else
#define LANES 32
#undef INFINITY
#define INFINITY (__longlong_as_double(0x7ff0000000000000LL))
#endif

#define FIRST (blockIdx.x * blockDim.x + threadIdx.x)
#define STRIDE (gridDim.x * blockDim.x)
#define EACH(k, n) for (place k = FIRST, end = (place)(n); k < end; k += STRIDE)

enum { SUM, LEAST, MOST };

__device__ double joined(double a, double b, int how) {
    return how == SUM ? a + b : how == LEAST ? fmin(a, b) : fmax(a, b);
}

// The same on all lanes of a warp.
__device__ double over_warp(double value, int how) {
#ifndef EMULATED
    for (int lane = LANES / 2; lane > 0; lane >>= 1)
        value = joined(value, __shfl_xor_sync(0xffffffff, value, lane), how);
#endif
    return value;
}

// Leave ``value`` over all threads of the block in its place of the column of ``partial``.
__device__ void leave(double value, int column, int how, double *partial) {
    __shared__ double warps[32];
    value = over_warp(value, how);
    if (threadIdx.x % LANES == 0) warps[threadIdx.x / LANES] = value;
    __syncthreads();
    if (threadIdx.x == 0) {
        for (int warp = 1; warp < blockDim.x / LANES; warp++) value = joined(value, warps[warp], how);
        partial[column * gridDim.x + blockIdx.x] = value;
    }
    __syncthreads();
}

// Cap of point k: none, one number, or one for each point.
__device__ double cap_at(const real *cap, whole caps, place k) {
    return caps == 0 ? INFINITY : (double)cap[caps == 1 ? 0 : k];
}

// Three sums: of a value, and of its products with two others.
__device__ void add_products(double value, double a, double b, double *sums) {
    sums[0] += value;
    sums[1] += value * a;
    sums[2] += value * b;
}

__device__ void leave_three(const double *sums, double *partial) {
    for (int column = 0; column < 3; column++) leave(sums[column], column, SUM, partial);
}

// Passes over a free set.

extern "C" __global__ void centred(const flag *inside, double mean, scalar *r, whole n) {
    EACH(k, n) if (inside[k]) r[k] -= (scalar)mean;
}

extern "C" __global__ void shifted(const flag *inside, const scalar *vector, double by, scalar *out, whole n) {
    EACH(k, n) out[k] = inside[k] ? vector[k] + (scalar)by : (scalar)0;
}

extern "C" __global__ void square(const scalar *vector, whole n, double *partial) {
    double sum = 0.0;
    EACH(k, n) sum += (double)vector[k] * (double)vector[k];
    leave(sum, 0, SUM, partial);
}

extern "C" __global__ void largest(const scalar *vector, whole n, double *partial) {
    double most = 0.0;
    EACH(k, n) most = fmax(most, (double)vector[k]);
    leave(most, 0, MOST, partial);
}

#define GATHER(name, type)                                                                                        \
    extern "C" __global__ void name(const flag *inside, const type *values, type *out, whole n, double *partial) { \
        double sum = 0.0;                                                                                         \
        EACH(k, n) {                                                                                              \
            out[k] = inside[k] ? values[k] : (type)0;                                                             \
            sum += (double)out[k];                                                                                \
        }                                                                                                         \
        leave(sum, 0, SUM, partial);                                                                              \
    }

GATHER(gather_iterate, real)
GATHER(gather_vector, scalar)

extern "C" __global__ void gather_products(
    const flag *inside, const scalar *field, const scalar *a, const scalar *b, scalar *out, whole n, double *partial) {
    double products[3] = {0.0, 0.0, 0.0};
    EACH(k, n) {
        double value = inside[k] ? (double)field[k] : 0.0;
        out[k] = (scalar)value;
        add_products(value, (double)a[k], (double)b[k], products);
    }
    leave_three(products, partial);
}

extern "C" __global__ void scatter_add(const scalar *values, double factor, scalar *field, whole n) {
    EACH(k, n) field[k] += (scalar)factor * values[k];
}

extern "C" __global__ void scatter_change(
    const flag *inside, const real *old, const real *values, const scalar *r, scalar *change, scalar *field, whole n,
    double *partial) {
    double along = 0.0;
    EACH(k, n) {
        change[k] = inside[k] ? (scalar)(values[k] - old[k]) : (scalar)0;
        field[k] = change[k];
        along += (double)change[k] * (double)r[k];
    }
    leave(along, 0, SUM, partial);
}

// ``field`` may be none.
extern "C" __global__ void update_direction(
    const flag *inside, const scalar *z, double mean, double ratio, scalar *t, const scalar *r, scalar *field, whole n,
    double *partial) {
    double slope = 0.0;
    EACH(k, n) {
        scalar next = inside[k] ? (z[k] - (scalar)mean) + (scalar)ratio * t[k] : (scalar)0;
        t[k] = next;
        if (field) field[k] = next;
        slope += (double)next * (double)r[k];
    }
    leave(slope, 0, SUM, partial);
}

extern "C" __global__ void update_solution(
    const flag *inside, double length, const scalar *t, const scalar *kt, double mean, scalar *d, scalar *r, whole n,
    double *partial) {
    double left = 0.0;
    EACH(k, n) {
        if (!inside[k]) continue;
        d[k] += (scalar)length * t[k];
        r[k] -= (scalar)length * (kt[k] - (scalar)mean);
        left += (double)r[k] * (double)r[k];
    }
    leave(left, 0, SUM, partial);
}

extern "C" __global__ void add_unclipped(
    const flag *inside, real *p, const scalar *d, double scale, whole n, double *partial) {
    double tensile = 0.0, tension = 0.0, carried = 0.0;
    EACH(k, n) {
        if (!inside[k]) continue;
        p[k] += (real)(scale * (double)d[k]);
        double value = (double)p[k];
        tensile += value < 0.0 ? 1.0 : 0.0;
        tension += fmax(-value, 0.0);
        carried += fmax(value, 0.0);
    }
    leave(tensile, 0, SUM, partial);
    leave(tension, 1, SUM, partial);
    leave(carried, 2, SUM, partial);
}

extern "C" __global__ void clear_tension(
    const flag *inside, real *p, double factor, double scale, scalar *change, whole n) {
    EACH(k, n) {
        change[k] = (scalar)0;
        if (!inside[k]) continue;
        real value = p[k] > (real)0 ? (real)(factor * (double)p[k]) : (real)0;
        change[k] = (scalar)((double)(value - p[k]) / scale);
        p[k] = value;
    }
}

extern "C" __global__ void loaded(
    const flag *inside, const real *values, const scalar *vector, flag *left, real *on_left, scalar *out, whole n,
    double *partial) {
    double size = 0.0, carried = 0.0;
    EACH(k, n) {
        left[k] = inside[k] && values[k] > (real)0;
        on_left[k] = left[k] ? values[k] : (real)0;
        out[k] = left[k] ? vector[k] : (scalar)0;
        size += left[k];
        carried += on_left[k];
    }
    leave(size, 0, SUM, partial);
    leave(carried, 1, SUM, partial);
}

extern "C" __global__ void change(
    const flag *inside, const real *values, const real *before, double scale, scalar *out, whole n) {
    EACH(k, n) out[k] = inside[k] ? (scalar)(((double)values[k] - (double)before[k]) / scale) : (scalar)0;
}

extern "C" __global__ void put(const flag *inside, const real *values, real *p, whole n) {
    EACH(k, n) {
        if (inside[k]) p[k] = values[k];
    }
}

// Load of the points p of a free set, and of those below the cap with their number.
__device__ void add_load(double p, double cap, double *load) {
    load[0] += p;
    if (p < cap) {
        load[1] += p;
        load[2] += 1.0;
    }
}

extern "C" __global__ void add_clipped(
    const flag *inside, real *p, const scalar *d, double scale, const real *cap, whole caps, whole n, double *partial) {
    double load[3] = {0.0, 0.0, 0.0}, clipped = 0.0;
    EACH(k, n) {
        if (!inside[k]) continue;
        double most = cap_at(cap, caps, k);
        real moved = p[k] + (real)(scale * (double)d[k]);
        real value = moved > (real)0 ? moved : (real)0;
        if ((double)value > most) value = (real)most;
        clipped += value != moved ? 1.0 : 0.0;
        p[k] = value;
        add_load((double)value, most, load);
    }
    leave_three(load, partial);
    leave(clipped, 3, SUM, partial);
}

extern "C" __global__ void rescale(
    const flag *inside, real *p, double factor, double shift, double near_cap, const real *cap, whole caps, whole n,
    double *partial) {
    double load[3] = {0.0, 0.0, 0.0};
    EACH(k, n) {
        if (!inside[k]) continue;
        double most = cap_at(cap, caps, k);
        if ((double)p[k] < most) {
            double moved = factor * (double)p[k] + shift;
            p[k] = (real)(moved < near_cap * most ? moved : most);
        }
        add_load((double)p[k], most, load);
    }
    leave_three(load, partial);
}

extern "C" __global__ void interpolate(const flag *inside, const real *old, double share, real *values, whole n) {
    EACH(k, n) if (inside[k]) values[k] = old[k] + (real)share * (values[k] - old[k]);
}

// Passes over an iterate.

extern "C" __global__ void add(const scalar *field, double factor, real *values, whole n) {
    EACH(k, n) values[k] += (real)(factor * (double)field[k]);
}

// A warp goes through one square of SIDE points a side after the other.
extern "C" __global__ void survey(
    const real *p, const real *u, const real *h, const real *cap, whole caps, whole nx, whole ny, double *squares,
    double *partial) {
    double pressure = 0.0, deflected = 0.0, work = 0.0, weight = 0.0, weighted = 0.0;
    double lowest = INFINITY, highest_capped = -INFINITY, lowest_open = INFINITY;
    place rows = (place)nx, row = (place)ny, across = (row + SIDE - 1) / SIDE, number = (rows + SIDE - 1) / SIDE * across;
    for (place square = FIRST / LANES; square < number; square += STRIDE / LANES) {
        double count = 0.0, sum = 0.0, squared = 0.0;
        place top = square / across * SIDE, left = square % across * SIDE;
        for (place point = threadIdx.x % LANES; point < SIDE * SIDE; point += LANES) {
            place i = top + point / SIDE, j = left + point % SIDE, k = i * row + j;
            if (i >= rows || j >= row) continue;
            double r = (double)u[k] - (double)h[k], value = fmax((double)p[k], 0.0);
            int capped = value > 0.0 && value >= cap_at(cap, caps, k);
            pressure += value;
            deflected += value * (double)u[k];
            work += value * r;
            lowest = fmin(lowest, r);
            if (value > 0.0) {
                if (capped) {
                    highest_capped = fmax(highest_capped, r);
                } else {
                    weight += value;
                    weighted += value * r;
                    count += 1.0;
                    sum += r;
                    squared += r * r;
                }
            } else {
                lowest_open = fmin(lowest_open, r);
            }
        }
        count = over_warp(count, SUM);
        sum = over_warp(sum, SUM);
        squared = over_warp(squared, SUM);
        if (threadIdx.x % LANES == 0) {
            squares[3 * square] = count;
            squares[3 * square + 1] = sum;
            squares[3 * square + 2] = squared;
        }
    }
    leave(pressure, 0, SUM, partial);
    leave(deflected, 1, SUM, partial);
    leave(work, 2, SUM, partial);
    leave(weight, 3, SUM, partial);
    leave(weighted, 4, SUM, partial);
    leave(lowest, 5, LEAST, partial);
    leave(highest_capped, 6, MOST, partial);
    leave(lowest_open, 7, LEAST, partial);
}

extern "C" __global__ void free_set(
    const real *p, const real *u, const real *h, const real *cap, whole caps, whole nx, whole ny, const double *levels,
    double level, double scale, flag *inside, scalar *start, double *partial) {
    double size = 0.0, entering = 0.0, sum = 0.0;
    place row = (place)ny, across = (row + SIDE - 1) / SIDE;
    EACH(k, nx * ny) {
        place square = k / row / SIDE * across + k % row / SIDE;
        double r = (double)u[k] - (double)h[k], value = (double)p[k];
        int capped = value > 0.0 && value >= cap_at(cap, caps, k);
        int enters = (value == 0.0 && r < levels[2 * square]) || (capped && r > levels[2 * square + 1]);
        inside[k] = enters || (value > 0.0 && !capped);
        start[k] = inside[k] ? (scalar)((level - r) / scale) : (scalar)0;
        size += inside[k];
        entering += enters;
        sum += (double)start[k];
    }
    leave(size, 0, SUM, partial);
    leave(entering, 1, SUM, partial);
    leave(sum, 2, SUM, partial);
}

extern "C" __global__ void violation(
    const real *p, const real *u, const real *h, const real *cap, whole caps, double level, whole n, double *partial) {
    double above = 0.0, below = 0.0, deepest = 0.0;
    EACH(k, n) {
        double gap = (double)u[k] - (double)h[k] - level, value = fmax((double)p[k], 0.0);
        if (gap > 0.0) {
            above += gap * value;
        } else if (gap < 0.0) {
            double room = cap_at(cap, caps, k) - value;
            if (room > 0.0) {
                below += caps ? -gap * room : INFINITY;
                deepest = fmax(deepest, -gap);
            }
        }
    }
    leave(above, 0, SUM, partial);
    leave(below, 1, SUM, partial);
    leave(deepest, 2, MOST, partial);
}

extern "C" __global__ void prolonged(
    const double *coarse, const double *coarse_heights, const double *heights, double stiffness, whole nx, whole ny,
    double *out) {
    place row = (place)ny, coarse_row = (row + 1) / 2;
    EACH(k, nx * ny) {
        place cell = k / row / 2 * coarse_row + k % row / 2;
        double p = coarse[cell];
        out[k] = p > 0.0 ? fmax(p + stiffness * (heights[k] - coarse_heights[cell]), 0.0) : 0.0;
    }
}

// Nested splines. Sums over the cells of all levels lie one after the other in ``sums``, their factors g in ``factors``, deflections in ``cells``.

struct Level {
    int nx, ny;            // parts
    int cells_x, cells_y;  // cells that they form
    int merges_x, merges_y;
    int parts, cells;      // where parts and cells lie in ``sums``; parts of the first level are the points
    int averages_x, averages_y;
};

// Index of the part ``i`` along an axis of ``n``, which wraps after ``period``; -1 where there is none.
__device__ int part_at(int i, int n, int period, int wraps) {
    if (wraps) i = i < 0 ? i + period : i >= period ? i - period : i;
    return i < 0 || i >= n ? -1 : i;
}

// Sum over the parts of cell (i, j) of a level, which reach one beyond the two that lie in it.
__device__ scalar sum_of_parts(const scalar *parts, const Level *level, int wraps_x, int wraps_y, int i, int j) {
    const scalar share[4] = {(scalar)0.25, (scalar)0.75, (scalar)0.75, (scalar)0.25};
    scalar sum = (scalar)0;
    int first_x = 2 * (wraps_x ? i : i - 1) - 1, first_y = 2 * (wraps_y ? j : j - 1) - 1;
    for (int a = 0; a < (level->merges_x ? 4 : 1); a++) {
        int x = level->merges_x ? part_at(first_x + a, level->nx, 2 * level->cells_x, wraps_x) : i;
        if (x < 0) continue;
        scalar line = (scalar)0;
        for (int b = 0; b < (level->merges_y ? 4 : 1); b++) {
            int y = level->merges_y ? part_at(first_y + b, level->ny, 2 * level->cells_y, wraps_y) : j;
            if (y >= 0) line += (level->merges_y ? share[b] : (scalar)1) * parts[(place)x * level->ny + y];
        }
        sum += (level->merges_x ? share[a] : (scalar)1) * line;
    }
    return sum;
}

// Deflection of part (i, j) of a level by the cells: three quarters of that which it lies in, a quarter of the nearest other one.
__device__ scalar by_cells(const scalar *cells, const Level *level, int wraps_x, int wraps_y, int i, int j) {
    int x = i, y = j, other_x = i, other_y = j;
    if (level->merges_x) {
        x = wraps_x ? i / 2 : i / 2 + 1;
        other_x = i % 2 ? x + 1 : x - 1;
        if (wraps_x) other_x = other_x < 0 ? level->cells_x - 1 : other_x == level->cells_x ? 0 : other_x;
    }
    if (level->merges_y) {
        y = wraps_y ? j / 2 : j / 2 + 1;
        other_y = j % 2 ? y + 1 : y - 1;
        if (wraps_y) other_y = other_y < 0 ? level->cells_y - 1 : other_y == level->cells_y ? 0 : other_y;
    }
    const scalar *own = cells + (place)x * level->cells_y, *other = cells + (place)other_x * level->cells_y;
    const scalar near = (scalar)0.75, far = (scalar)0.25;
    return near * (near * own[y] + far * own[other_y]) + far * (near * other[y] + far * other[other_y]);
}

enum { INVERT, DEFLECT, FACTORISE };

__device__ void rise_to(
    const Level *level, int way, int wraps_x, int wraps_y, double weight, const scalar *points, scalar *sums,
    scalar *factors, place cell) {
    const scalar *parts = level->parts < 0 ? points : sums + level->parts;
    scalar sum = sum_of_parts(parts, level, wraps_x, wraps_y, cell / (place)level->cells_y, cell % (place)level->cells_y);
    scalar *factor = factors + level->cells + cell;
    if (way == FACTORISE) *factor = (scalar)1 / ((scalar)1 + (scalar)weight * sum);
    sums[level->cells + cell] = way == DEFLECT ? sum : *factor * sum;
}

// Average over cell (i, j) of a level and those beside it: half of its own and a quarter on either side, along the axes of which it is asked.
__device__ scalar averaged(const scalar *sums, const Level *level, int wraps_x, int wraps_y, int i, int j) {
    const scalar share[3] = {(scalar)0.25, (scalar)0.5, (scalar)0.25};
    scalar sum = (scalar)0;
    for (int a = level->averages_x ? 0 : 1; a < (level->averages_x ? 3 : 2); a++) {
        int x = part_at(i + a - 1, level->cells_x, level->cells_x, wraps_x);
        if (x < 0) continue;
        scalar line = (scalar)0;
        for (int b = level->averages_y ? 0 : 1; b < (level->averages_y ? 3 : 2); b++) {
            int y = part_at(j + b - 1, level->cells_y, level->cells_y, wraps_y);
            if (y >= 0) line += (level->averages_y ? share[b] : (scalar)1) * sums[(place)x * level->cells_y + y];
        }
        sum += (level->averages_x ? share[a] : (scalar)1) * line;
    }
    return sum;
}

// Deflection w S + g d of a cell by the sums S of its level, or w times their average + d; d is the deflection by the levels above (none above the last).
__device__ void fall_to(
    const Level *level, int last, int way, int wraps_x, int wraps_y, double weight, const scalar *sums,
    const scalar *factors, const scalar *cells, scalar *target, place cell) {
    int i = cell / (place)level->cells_y, j = cell % (place)level->cells_y;
    scalar above = (scalar)0;
    if (!last) {
        const Level *next = level + 1;
        above = by_cells(cells + next->cells, next, wraps_x, wraps_y, i, j);
        if (way == INVERT) above *= factors[level->cells + cell];
    }
    scalar own = way == INVERT ? sums[level->cells + cell] : averaged(sums + level->cells, level, wraps_x, wraps_y, i, j);
    target[level->cells + cell] = (scalar)weight * own + above;
}

extern "C" __global__ void rise(
    const Level *level, whole way, whole wraps_x, whole wraps_y, const double *weight, const scalar *points,
    scalar *sums, scalar *factors) {
    EACH(cell, (place)level->cells_x * level->cells_y)
        rise_to(level, way, wraps_x, wraps_y, *weight, points, sums, factors, cell);
}

// Deflections of the cells of a level, left in ``target``, by those of the level above in ``cells``; of the ``last`` level there are none above.
extern "C" __global__ void fall(
    const Level *level, whole last, whole way, whole wraps_x, whole wraps_y, const double *weight, const scalar *sums,
    const scalar *factors, const scalar *cells, scalar *target) {
    EACH(cell, (place)level->cells_x * level->cells_y)
        fall_to(level, last, way, wraps_x, wraps_y, *weight, sums, factors, cells, target, cell);
}

// What the correction for row sums takes of a level: the mean of what the four parts between the middles of each cell and those after it pass up, and ``share`` over its sum.
extern "C" __global__ void overlap(
    const Level *level, whole wraps_x, whole wraps_y, double share, const scalar *points, const scalar *sums,
    const scalar *factors, scalar *mean, scalar *per) {
    const scalar *parts = level->parts < 0 ? points : sums + level->parts;
    EACH(cell, (place)level->cells_x * level->cells_y) {
        int first_x = 2 * (int)(cell / (place)level->cells_y) + (wraps_x ? 1 : -1);
        int first_y = 2 * (int)(cell % (place)level->cells_y) + (wraps_y ? 1 : -1);
        scalar sum = (scalar)0;
        for (int a = 0; a < 2; a++)
            for (int b = 0; b < 2; b++) {
                int x = part_at(first_x + a, level->nx, 2 * level->cells_x, wraps_x);
                int y = part_at(first_y + b, level->ny, 2 * level->cells_y, wraps_y);
                if (x >= 0 && y >= 0) sum += parts[(place)x * level->ny + y];
            }
        place k = level->cells + cell;
        mean[k] = (scalar)0.25 * sum;
        per[k] = (scalar)share * factors[k] / (sums[k] + (scalar)1e-30);
    }
}

// ``cells`` = raw + per H raw on a level, H being what row sums of the products of B-splines exceed these by.
extern "C" __global__ void corrected(
    const Level *level, whole wraps_x, whole wraps_y, const scalar *mean, const scalar *per, const scalar *raw,
    scalar *cells) {
    int nx = level->cells_x, ny = level->cells_y;
    const scalar *values = raw + level->cells;
    EACH(cell, (place)nx * ny) {
        int i = cell / (place)ny, j = cell % (place)ny;
        scalar missing = (scalar)0, own = values[cell];
        for (int a = -1; a <= 1; a += 2)
            for (int b = -1; b <= 1; b += 2) {
                int x = part_at(i + a, nx, nx, wraps_x), y = part_at(j + b, ny, ny, wraps_y);
                if (x < 0 || y < 0) continue;
                place block = (place)(a < 0 ? x : i) * ny + (b < 0 ? y : j);
                scalar beside = values[(place)x * ny + j] + values[(place)i * ny + y];
                missing += mean[level->cells + block] * ((scalar)0.609375 * own - (scalar)0.234375 * beside
                                                         - (scalar)0.140625 * values[(place)x * ny + y]);
            }
        cells[level->cells + cell] = own + per[level->cells + cell] * missing;
    }
}

// Up and down the last ``number`` levels, which are small, in a single block.
extern "C" __global__ void turn(
    const Level *levels, whole number, whole way, whole wraps_x, whole wraps_y, const double *weights,
    const scalar *points, scalar *sums, scalar *factors, scalar *cells) {
    for (int l = 0; l < number; l++) {
        for (place cell = threadIdx.x; cell < (place)levels[l].cells_x * levels[l].cells_y; cell += blockDim.x)
            rise_to(levels + l, way, wraps_x, wraps_y, weights[l], points, sums, factors, cell);
        __syncthreads();
    }
    for (int l = (int)number - 1; l >= 0 && way != FACTORISE; l--) {
        for (place cell = threadIdx.x; cell < (place)levels[l].cells_x * levels[l].cells_y; cell += blockDim.x)
            fall_to(levels + l, l == number - 1, way, wraps_x, wraps_y, weights[l], sums, factors, cells, cells, cell);
        __syncthreads();
    }
}

// Value so many rows and columns away; zero beyond a rim that does not wrap.
#define AT(values, x, y) \
    (part_at(x, level->nx, level->nx, wraps_x) < 0 || part_at(y, level->ny, level->ny, wraps_y) < 0 \
         ? (scalar)0 \
         : (scalar)(values)[(place)part_at(x, level->nx, level->nx, wraps_x) * level->ny \
                            + part_at(y, level->ny, level->ny, wraps_y)])

struct Local {
    double own[4], stiffness, fall[2], bend[2];
};

// Entry of the local stiffness of point (i, j) without its neighbours, those of the nearest points, and those at twice the distance, along x and y.
__device__ scalar alone(const Level *level, int wraps_x, int wraps_y, const Local *local, const flag *inside, int i, int j) {
    scalar members_x = AT(inside, i - 1, j) + AT(inside, i + 1, j);
    scalar members_y = AT(inside, i, j - 1) + AT(inside, i, j + 1);
    return (scalar)(1.0 + 0.375 * (local->bend[0] + local->bend[1]))
           + (scalar)(0.25 * local->fall[0]) * members_x + (scalar)(0.25 * local->fall[1]) * members_y;
}

#define BESIDE(values, i, j) \
    ((level->nx > 1 ? (scalar)(-0.25 * (local->fall[0] + local->bend[0])) * (AT(values, i - 1, j) + AT(values, i + 1, j)) \
                          + (scalar)(0.0625 * local->bend[0]) * (AT(values, i - 2, j) + AT(values, i + 2, j)) \
                    : (scalar)0) \
     + (level->ny > 1 ? (scalar)(-0.25 * (local->fall[1] + local->bend[1])) * (AT(values, i, j - 1) + AT(values, i, j + 1)) \
                            + (scalar)(0.0625 * local->bend[1]) * (AT(values, i, j - 2) + AT(values, i, j + 2)) \
                      : (scalar)0))

// Sum of the row of the local stiffness of every point of the set, zero elsewhere.
extern "C" __global__ void local_stiffness(
    const Level *level, whole wraps_x, whole wraps_y, const Local *local, const flag *inside, scalar *together) {
    EACH(k, (place)level->nx * level->ny) {
        int i = k / (place)level->ny, j = k % (place)level->ny;
        together[k] = inside[k] ? alone(level, wraps_x, wraps_y, local, inside, i, j) + BESIDE(inside, i, j) : (scalar)0;
    }
}

// z = inverse times r on the set, with its sum and its products with r and ``other``; if ``sums``, the cells count by the row sums ``together``.
extern "C" __global__ void invert_points(
    const Level *level, whole wraps_x, whole wraps_y, whole sums, const Local *local, const scalar *cells,
    const flag *inside, const scalar *together, const scalar *r, const scalar *other, scalar *out, double *partial) {
    double products[3] = {0.0, 0.0, 0.0};
    EACH(k, (place)level->nx * level->ny) {
        scalar z = (scalar)0;
        if (inside[k]) {
            int i = k / (place)level->ny, j = k % (place)level->ny;
            z = alone(level, wraps_x, wraps_y, local, inside, i, j) * r[k] + BESIDE(r, i, j)
                - (sums ? together[k] : (scalar)1) * by_cells(cells, level, wraps_x, wraps_y, i, j);
            z *= (scalar)local->stiffness;
        }
        out[k] = z;
        add_products((double)z, (double)r[k], (double)other[k], products);
    }
    leave_three(products, partial);
}

// Deflection by the load t on the set, with its sum and its products with t and ``other``; what it leaves of ``other`` if ``less``.
extern "C" __global__ void deflect_points(
    const Level *level, whole wraps_x, whole wraps_y, const Local *local, const scalar *cells, const flag *inside,
    const scalar *t, const scalar *other, whole less, scalar *out, double *partial) {
    double products[3] = {0.0, 0.0, 0.0};
    EACH(k, (place)level->nx * level->ny) {
        scalar found = (scalar)0;
        if (inside[k]) {
            int i = k / (place)level->ny, j = k % (place)level->ny;
            scalar diagonal = AT(t, i - 1, j - 1) + AT(t, i - 1, j + 1) + AT(t, i + 1, j - 1) + AT(t, i + 1, j + 1);
            found = (scalar)local->own[0] * t[k] + by_cells(cells, level, wraps_x, wraps_y, i, j);
            found += (scalar)(0.5 * local->own[1]) * (AT(t, i - 1, j) + AT(t, i + 1, j));
            found += (scalar)(0.5 * local->own[2]) * (AT(t, i, j - 1) + AT(t, i, j + 1));
            found += (scalar)(0.25 * local->own[3]) * diagonal;
        }
        out[k] = less ? other[k] - found : found;
        add_products((double)found, (double)t[k], (double)other[k], products);
    }
    leave_three(products, partial);
}

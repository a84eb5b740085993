// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Options:
//   RECTIFY (for each pixel of the global-shutter camera the raw pixel) or DISTORT (the other way round)
//   LENS_BROWN or LENS_FISHEYE (none: no distortion), TILTED (with LENS_BROWN)
//   MOVING: there is a motion besides the lens
//   RELIEF: the scene of the motion deviates from its planes
//   MAP_32FC1, MAP_32FC2 or MAP_16SC2
//   MASK: the mask is wanted

// The same as in map_ocl.cpp.
struct Warp
{
    float newFx, newFy, newCx, newCy, newSkew; // global-shutter camera
    float fx, fy, cx, cy;                      // raw image
    float k[12];
    float tilt[9]; // DISTORT: its inverse
    float maxRadius2;
    float up[9];
    float B, D, lambda, G, direction;
    float offsetX, offsetY, cellsPerX, cellsPerY; // where the cells of the inverse-depth offset begin, and how many there are for 1
    int offsetColumns, offsetRows;                // control values
    float alpha, cosHeading, sinHeading;
    float reference, timeStep;
    float timeTolerance;
    int byRows;
    int maxIterations;
    int width, height; // of the image that the map points into
};

#define FAR_OUTSIDE -16384.f

inline float rowTime(const struct Warp* p, float2 raw)
{
    return p->timeStep * ((p->byRows ? raw.y : raw.x) - p->reference);
}

// The motion at a row time: sin(theta), cos(theta) - 1, and the place of the camera.
struct RowMotion
{
    float s, c1;
    float ex, ez;
    float passed; // part of the way to the left wall, of that to the right wall by -lambda
};

inline struct RowMotion motionAt(const struct Warp* p, float t)
{
    const float h = p->alpha * t;
    const float sh = sin(h), ch = cos(h);
    const float tau = t * (fabs(h) < 1e-2f ? 1.f - h * h / 6.f : sh / h);
    struct RowMotion m;
    m.s = 2.f * sh * ch;
    m.c1 = -2.f * sh * sh;
    m.ex = tau * (sh * p->cosHeading + ch * p->sinHeading);
    m.ez = tau * (ch * p->cosHeading - sh * p->sinHeading);
    m.passed = p->D * m.ez - p->B * m.ex;
    return m;
}

inline int isInside(const struct Warp* p, const struct RowMotion* m)
{
    return m->passed < 1.f && -p->lambda * m->passed < 1.f;
}

inline float3 bearing(const struct Warp* p, float2 ray)
{
    return (float3)(p->up[0] * ray.x + p->up[1] * ray.y + p->up[2], p->up[3] * ray.x + p->up[4] * ray.y + p->up[5],
                    p->up[6] * ray.x + p->up[7] * ray.y + p->up[8]);
}

// Changes the ray (x, y, 1) as its bearing changes in x and z. The change is small, and so is its rounding error.
inline int changeRay(const struct Warp* p, float bx, float bz, float2* ray)
{
    const float dx = p->up[0] * bx + p->up[6] * bz, dy = p->up[1] * bx + p->up[7] * bz,
                dz = p->up[2] * bx + p->up[8] * bz;
    const float z = 1.f + dz;
    if (!(z > 0.f))
        return 0;
    *ray += (float2)(dx - ray->x * dz, dy - ray->y * dz) / z;
    return 1;
}

// Scaled inverse depth of the nearest plane from its values at infinity, on the left wall, the right wall and the road.
inline float nearest(const struct Warp* p, float infinite, float left, float right, float road)
{
    return p->direction * fmax(fmax(fmax(p->direction * left, p->direction * right), p->direction * road),
                               p->direction * infinite);
}

#ifdef RELIEF
// The first of the four control values that count along one axis, and their weights.
inline int splineWeights(float at, int controls, float4* weights)
{
    const float place = at > 0.f ? fmin(at, controls - 3.f) : 0.f; // NaN too
    const int cell = min((int)place, controls - 4);
    const float f = place - cell, g = 1.f - f;
    *weights = (float4)(g * g * g, 4.f + 3.f * f * f * (f - 2.f), 4.f + 3.f * g * g * (g - 2.f), f * f * f) / 6.f;
    return cell;
}
#endif

// By how much the scene is nearer than its planes in the direction b.
inline float inverseDepthOffset(const struct Warp* p, __global const float* controls, float3 b)
{
    float sum = 0.f;
#ifdef RELIEF
    if (!(b.z > 0.f))
        return 0.f;
    float4 x, y;
    const int column = splineWeights((b.x / b.z - p->offsetX) * p->cellsPerX, p->offsetColumns, &x);
    const int row = splineWeights((b.y / b.z - p->offsetY) * p->cellsPerY, p->offsetRows, &y);
    const float weights[4] = {y.x, y.y, y.z, y.w};
    for (int i = 0; i < 4; i++)
        sum += weights[i] * dot(x, vload4(0, controls + (row + i) * p->offsetColumns + column));
    sum *= b.z;
#endif
    return sum;
}

#ifdef LENS_BROWN
inline float brownRadial(const struct Warp* p, float r2, float* denominator)
{
    *denominator = 1.f + r2 * (p->k[5] + r2 * (p->k[6] + r2 * p->k[7]));
    return (1.f + r2 * (p->k[0] + r2 * (p->k[1] + r2 * p->k[4]))) / *denominator;
}

inline float2 brown(const struct Warp* p, float2 ray)
{
    const float x = ray.x, y = ray.y, r2 = x * x + y * y, xy2 = 2.f * x * y;
    float denominator;
    const float radial = brownRadial(p, r2, &denominator);
    return (float2)(x * radial + p->k[2] * xy2 + p->k[3] * (r2 + 2.f * x * x) + r2 * (p->k[8] + r2 * p->k[9]),
                    y * radial + p->k[2] * (r2 + 2.f * y * y) + p->k[3] * xy2 + r2 * (p->k[10] + r2 * p->k[11]));
}

#ifdef TILTED
inline int tilted(const struct Warp* p, float2* point)
{
    const float x = point->x, y = point->y;
    const float z = p->tilt[6] * x + p->tilt[7] * y + p->tilt[8];
    *point = (float2)(p->tilt[0] * x + p->tilt[1] * y + p->tilt[2], p->tilt[3] * x + p->tilt[4] * y + p->tilt[5]) / z;
    return z > 0.f;
}
#endif
#endif

#ifdef LENS_FISHEYE
inline float fisheyeRadial(const struct Warp* p, float theta2)
{
    return 1.f + theta2 * (p->k[0] + theta2 * (p->k[1] + theta2 * (p->k[2] + theta2 * p->k[3])));
}
#endif

#ifdef RECTIFY

inline int lens(const struct Warp* p, float2 ray, float2* raw)
{
#ifdef LENS_BROWN
    if (!(dot(ray, ray) <= p->maxRadius2))
        return 0;
    ray = brown(p, ray);
#ifdef TILTED
    if (!tilted(p, &ray))
        return 0;
#endif
#endif
#ifdef LENS_FISHEYE
    const float r2 = dot(ray, ray);
    if (!(r2 <= p->maxRadius2))
        return 0;
    const float r = sqrt(r2), theta = atan(r), radial = fisheyeRadial(p, theta * theta);
    ray *= r > 0.f ? theta * radial / r : radial;
#endif
    *raw = (float2)(p->fx * ray.x + p->cx, p->fy * ray.y + p->cy);
    return 1;
}

// The raw pixel that sees the point with the ray, its bearing b and scaled inverse depth w at the time t.
inline int project(const struct Warp* p, float2 ray, float3 b, float w, float t, float2* raw, int* inside)
{
    const struct RowMotion m = motionAt(p, t);
    const float bx = b.x - w * m.ex, bz = b.z - w * m.ez;
    *inside = isInside(p, &m);
    return changeRay(p, m.c1 * bx - m.s * bz - w * m.ex, m.s * bx + m.c1 * bz - w * m.ez, &ray) && lens(p, ray, raw);
}

inline float2 placeOf(const struct Warp* p, __global const float* controls, float2 pixel)
{
    const float2 none = (float2)(FAR_OUTSIDE, FAR_OUTSIDE);
    const float y = (pixel.y - p->newCy) / p->newFy;
    const float2 ray = (float2)((pixel.x - p->newCx - p->newSkew * y) / p->newFx, y);
    float2 raw;
    const int hasLensPixel = lens(p, ray, &raw);
#ifndef MOVING
    return hasLensPixel ? raw : none;
#else
    const float3 b = bearing(p, ray);
    const float left = p->D * b.z - p->B * b.x;
    const float w = nearest(p, 0.f, left, -p->lambda * left, p->G * b.y) + inverseDepthOffset(p, controls, b);

    float time = hasLensPixel ? rowTime(p, raw) : 0.f;
    float slope = 0.f, lastTime = 0.f, lastValue = 0.f;
    for (int i = 0; i < p->maxIterations; i++)
    {
        int inside;
        if (!project(p, ray, b, w, time, &raw, &inside))
            return none;
        const float value = rowTime(p, raw);
        if (fabs(value - time) <= p->timeTolerance)
            return inside ? raw : none;
        if (i > 0)
            slope = fmin((value - lastValue) / (time - lastTime), 0.9f);
        lastTime = time;
        lastValue = value;
        time += (value - time) / (1.f - slope);
    }
    return none;
#endif
}

#else // DISTORT

// If the inverse of the lens model is found to less than this, it is the rounding that is left.
#define LENS_RESIDUAL 2e-6f

#ifdef LENS_BROWN
// Newton's step from a ray whose distorted point is off by the error.
inline int brownStep(const struct Warp* p, float2 ray, float2 error, float2* step)
{
    const float x = ray.x, y = ray.y, r2 = x * x + y * y;
    float denominator;
    const float radial = brownRadial(p, r2, &denominator);
    const float slope = 2.f * (p->k[0] + r2 * (2.f * p->k[1] + r2 * 3.f * p->k[4]) -
                               radial * (p->k[5] + r2 * (2.f * p->k[6] + r2 * 3.f * p->k[7]))) / denominator;
    const float prismX = 2.f * p->k[8] + 4.f * r2 * p->k[9], prismY = 2.f * p->k[10] + 4.f * r2 * p->k[11];
    const float common = x * y * slope + 2.f * (p->k[2] * x + p->k[3] * y);
    const float xx = radial + x * x * slope + 2.f * p->k[2] * y + 6.f * p->k[3] * x + x * prismX,
                xy = common + y * prismX;
    const float yx = common + x * prismY,
                yy = radial + y * y * slope + 6.f * p->k[2] * y + 2.f * p->k[3] * x + y * prismY;
    const float det = xx * yy - xy * yx;
    *step = (float2)(error.x * yy - error.y * xy, error.y * xx - error.x * yx) / det;
    return det != 0.f;
}

// Steps that don't come nearer are halved.
inline int inverseLens(const struct Warp* p, float2* ray)
{
#ifdef TILTED
    if (!tilted(p, ray))
        return 0;
#endif
    const float2 distorted = *ray;
    float2 at = distorted;
    const float size2 = dot(at, at);
    if (size2 > p->maxRadius2)
        at *= 0.99f * sqrt(p->maxRadius2 / size2);
    float2 error = brown(p, at) - distorted, step;
    for (int i = 0; i < 30 && brownStep(p, at, error, &step); i++)
    {
        int nearer = 0;
        for (int halvings = 0; halvings < 10 && !nearer; halvings++, step *= 0.5f)
        {
            const float2 next = at - step, nextError = brown(p, next) - distorted;
            nearer = dot(next, next) <= p->maxRadius2 && dot(nextError, nextError) < dot(error, error);
            if (nearer)
            {
                at = next;
                error = nextError;
            }
        }
        if (!nearer)
            break;
    }
    *ray = at;
    return fast_length(error) <= LENS_RESIDUAL * (1.f + fast_length(distorted));
}
#elif defined LENS_FISHEYE
inline int inverseLens(const struct Warp* p, float2* ray)
{
    const float* k = p->k;
    const float radius = length(*ray), limit = fmin(atan(sqrt(p->maxRadius2)), 1.570796f);
    float theta = fmin(radius, limit), error = 0.f;
    for (int i = 0; i < 30; i++)
    {
        const float t2 = theta * theta;
        error = theta * fisheyeRadial(p, t2) - radius;
        const float slope = 1.f + t2 * (3.f * k[0] + t2 * (5.f * k[1] + t2 * (7.f * k[2] + t2 * 9.f * k[3])));
        if (fabs(error) < 1e-7f || !(slope > 0.f))
            break;
        theta = clamp(theta - error / slope, 0.f, limit);
    }
    *ray *= radius > 0.f ? tan(theta) / radius : 0.f;
    return fabs(error) <= LENS_RESIDUAL * (1.f + radius);
}
#else
inline int inverseLens(const struct Warp* p, float2* ray)
{
    return 1;
}
#endif

inline float2 placeOf(const struct Warp* p, __global const float* controls, float2 pixel)
{
    const float2 none = (float2)(FAR_OUTSIDE, FAR_OUTSIDE);
    float2 ray = (float2)((pixel.x - p->cx) / p->fx, (pixel.y - p->cy) / p->fy);
    if (!inverseLens(p, &ray))
        return none;
#ifdef MOVING
    const struct RowMotion m = motionAt(p, rowTime(p, pixel));
    if (!isInside(p, &m))
        return none;
    const float3 b = bearing(p, ray);
    const float dx = m.c1 * b.x + m.s * b.z, dz = m.c1 * b.z - m.s * b.x;
    const float left = p->D * (b.z + dz) - p->B * (b.x + dx);
    const float toLeft = 1.f - m.passed, toRight = 1.f + p->lambda * m.passed;
    float w = nearest(p, 0.f, left / toLeft, -p->lambda * left / toRight, p->G * b.y);
#ifdef RELIEF
    int found = 0;
    for (int i = 0; i < 30 && !found; i++)
    {
        const float last = w,
                    added = inverseDepthOffset(p, controls, (float3)(b.x + dx + w * m.ex, b.y, b.z + dz + w * m.ez));
        w = nearest(p, added, (left + added) / toLeft, (added - p->lambda * left) / toRight, p->G * b.y + added);
        found = fabs(w - last) <= 1e-6f * (1.f + fabs(w));
    }
    if (!found)
        return none;
#endif
    if (!changeRay(p, dx + w * m.ex, dz + w * m.ez, &ray))
        return none;
#endif
    return (float2)(p->newFx * ray.x + p->newSkew * ray.y + p->newCx, p->newFy * ray.y + p->newCy);
}

#endif

__kernel void warpMap(__global uchar* map1, int map1Step, int map1Offset,
#ifndef MAP_32FC2
                      __global uchar* map2, int map2Step, int map2Offset,
#endif
#ifdef MASK
                      __global uchar* mask, int maskStep, int maskOffset,
#endif
#ifdef RELIEF
                      __global const float* controls,
#endif
                      int rows, int cols, struct Warp p)
{
#ifndef RELIEF
    __global const float* controls = 0;
#endif
    const int u = get_global_id(0), v = get_global_id(1);
    if (u >= cols || v >= rows)
        return;

    float2 place = placeOf(&p, controls, (float2)(u, v));
    if (!(fabs(place.x) <= 32767.f && fabs(place.y) <= 32767.f))
        place = (float2)(FAR_OUTSIDE, FAR_OUTSIDE);

#ifdef MAP_32FC1
    *(__global float*)(map1 + v * map1Step + map1Offset + u * 4) = place.x;
    *(__global float*)(map2 + v * map2Step + map2Offset + u * 4) = place.y;
#endif
#ifdef MAP_32FC2
    *(__global float2*)(map1 + v * map1Step + map1Offset + u * 8) = place;
#endif
#ifdef MAP_16SC2
    const int2 fixed = convert_int2_sat_rte(place * 32.f);
    *(__global short2*)(map1 + v * map1Step + map1Offset + u * 4) = convert_short2_sat(fixed >> 5);
    *(__global ushort*)(map2 + v * map2Step + map2Offset + u * 2) = (ushort)((fixed.y & 31) * 32 + (fixed.x & 31));
#endif
#ifdef MASK
    const float slack = 1.f / 64;
    mask[v * maskStep + maskOffset + u] = place.x >= -slack && place.y >= -slack && place.x <= p.width - 1 + slack &&
                                          place.y <= p.height - 1 + slack ? 255 : 0;
#endif
}

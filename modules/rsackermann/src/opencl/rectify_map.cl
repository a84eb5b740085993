// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Options:
//   LENS_BROWN or LENS_FISHEYE (none: no distortion), TILTED (with LENS_BROWN)
//   MOVING: there is a motion besides the lens
//   MAP_32FC1, MAP_32FC2 or MAP_16SC2
//   MASK: the mask is wanted

// The same as in rectify_ocl.cpp.
struct Rectification
{
    float newSkew, newFx, newFy, newCx, newCy; // global-shutter camera; the focal lengths are inverses
    float fx, fy, cx, cy;
    float k[12];
    float tilt[9];
    float maxRadius2;
    float up[9];
    float B, D, lambda, G, direction;
    float alpha, cosHeading, sinHeading;
    float reference, timeStep;
    float timeTolerance;
    int byRows;
    int maxIterations;
    int width, height; // raw image
};

#define FAR_OUTSIDE -16384.f

inline int lens(const struct Rectification* p, float x, float y, float2* raw)
{
#ifdef LENS_BROWN
    const float r2 = x * x + y * y;
    if (!(r2 <= p->maxRadius2))
        return 0;
    const float radial = (1.f + r2 * (p->k[0] + r2 * (p->k[1] + r2 * p->k[4]))) / (1.f + r2 * (p->k[5] + r2 * (p->k[6] + r2 * p->k[7])));
    const float xy2 = 2.f * x * y;
    const float xd = x * radial + p->k[2] * xy2 + p->k[3] * (r2 + 2.f * x * x) + r2 * (p->k[8] + r2 * p->k[9]);
    const float yd = y * radial + p->k[2] * (r2 + 2.f * y * y) + p->k[3] * xy2 + r2 * (p->k[10] + r2 * p->k[11]);
    x = xd;
    y = yd;
#ifdef TILTED
    const float z = p->tilt[6] * xd + p->tilt[7] * yd + p->tilt[8];
    if (!(z > 0.f))
        return 0;
    x = (p->tilt[0] * xd + p->tilt[1] * yd + p->tilt[2]) / z;
    y = (p->tilt[3] * xd + p->tilt[4] * yd + p->tilt[5]) / z;
#endif
#endif
#ifdef LENS_FISHEYE
    const float r = sqrt(x * x + y * y);
    if (!(r * r <= p->maxRadius2))
        return 0;
    const float theta = atan(r), theta2 = theta * theta;
    const float radial = 1.f + theta2 * (p->k[0] + theta2 * (p->k[1] + theta2 * (p->k[2] + theta2 * p->k[3])));
    const float scale = r > 0.f ? theta * radial / r : radial;
    x *= scale;
    y *= scale;
#endif
    *raw = (float2)(p->fx * x + p->cx, p->fy * y + p->cy);
    return 1;
}

inline float rowTime(const struct Rectification* p, float2 raw)
{
    return p->timeStep * ((p->byRows ? raw.y : raw.x) - p->reference);
}

// The raw pixel that sees the point with the ray (x, y, 1), bearing b and scaled inverse depth w at the time t. The change of
// the ray is computed instead of the changed ray: it is small, and so is its rounding error.
inline int project(const struct Rectification* p, float x, float y, float3 b, float w, float t, float2* raw, int* inside)
{
    const float h = p->alpha * t;
    const float sh = sin(h), ch = cos(h);
    const float tau = t * (fabs(h) < 1e-2f ? 1.f - h * h / 6.f : sh / h);
    const float s2 = sh * p->cosHeading + ch * p->sinHeading, c2 = ch * p->cosHeading - sh * p->sinHeading;
    const float s = 2.f * sh * ch, c1 = -2.f * sh * sh;
    const float shift = tau * w;
    const float bx = b.x - shift * s2, bz = b.z - shift * c2;
    const float dbx = c1 * bx - s * bz - shift * s2, dbz = s * bx + c1 * bz - shift * c2;
    const float dx = p->up[0] * dbx + p->up[6] * dbz, dy = p->up[1] * dbx + p->up[7] * dbz, dz = p->up[2] * dbx + p->up[8] * dbz;
    const float z = 1.f + dz;
    if (!(z > 0.f))
        return 0;
    const float passed = tau * (p->D * c2 - p->B * s2);
    *inside = passed < 1.f && -p->lambda * passed < 1.f;
    return lens(p, x + (dx - x * dz) / z, y + (dy - y * dz) / z, raw);
}

inline float2 solve(const struct Rectification* p, float x, float y)
{
    const float2 none = (float2)(FAR_OUTSIDE, FAR_OUTSIDE);
    float2 raw;
    const int hasLensPixel = lens(p, x, y, &raw);
#ifndef MOVING
    return hasLensPixel ? raw : none;
#else
    const float3 b = (float3)(p->up[0] * x + p->up[1] * y + p->up[2], p->up[3] * x + p->up[4] * y + p->up[5],
                              p->up[6] * x + p->up[7] * y + p->up[8]);
    const float left = p->D * b.z - p->B * b.x;
    const float nearest = fmax(fmax(p->direction * left, -p->direction * p->lambda * left), p->direction * p->G * b.y);
    const float w = p->direction * fmax(nearest, 0.f);

    float time = hasLensPixel ? rowTime(p, raw) : 0.f;
    float slope = 0.f, lastTime = 0.f, lastValue = 0.f;
    for (int i = 0; i < p->maxIterations; i++)
    {
        int inside;
        if (!project(p, x, y, b, w, time, &raw, &inside))
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

__kernel void rectifyMap(__global uchar* map1, int map1Step, int map1Offset,
#ifndef MAP_32FC2
                         __global uchar* map2, int map2Step, int map2Offset,
#endif
#ifdef MASK
                         __global uchar* mask, int maskStep, int maskOffset,
#endif
                         int rows, int cols, struct Rectification p)
{
    const int u = get_global_id(0), v = get_global_id(1);
    if (u >= cols || v >= rows)
        return;

    const float y = (v - p.newCy) * p.newFy;
    const float x = (u - p.newCx - p.newSkew * y) * p.newFx;
    float2 raw = solve(&p, x, y);
    if (!(fabs(raw.x) <= 32767.f && fabs(raw.y) <= 32767.f))
        raw = (float2)(FAR_OUTSIDE, FAR_OUTSIDE);

#ifdef MAP_32FC1
    *(__global float*)(map1 + v * map1Step + map1Offset + u * 4) = raw.x;
    *(__global float*)(map2 + v * map2Step + map2Offset + u * 4) = raw.y;
#endif
#ifdef MAP_32FC2
    *(__global float2*)(map1 + v * map1Step + map1Offset + u * 8) = raw;
#endif
#ifdef MAP_16SC2
    const int2 fixed = convert_int2_sat_rte(raw * 32.f);
    *(__global short2*)(map1 + v * map1Step + map1Offset + u * 4) = convert_short2_sat(fixed >> 5);
    *(__global ushort*)(map2 + v * map2Step + map2Offset + u * 2) = (ushort)((fixed.y & 31) * 32 + (fixed.x & 31));
#endif
#ifdef MASK
    const float slack = 1.f / 64;
    mask[v * maskStep + maskOffset + u] = raw.x >= -slack && raw.y >= -slack && raw.x <= p.width - 1 + slack &&
                                          raw.y <= p.height - 1 + slack ? 255 : 0;
#endif
}

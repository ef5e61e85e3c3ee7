# Which headers users get: those of the libraries in `floors`, but for `left_out` (headers and folders, or how their
# names begin), which show types of a library that stays private.
set(floors base radiometry heat scene raycast sensor labels imaging io dataset analysis)
set(left_out
    base/happens_before.h
    dataset/videos/cell_painter.h dataset/videos/drawing.h
    io/exr/file.h io/exr/indices.h io/exr/pixels.h io/image/module/
    io/image/picture_module.h io/image/png_calls.h io/video/ffmpeg.h io/video/h264_writer.h
    raycast/embree.h raycast/first_hit.h raycast/frame_tracer.h raycast/mirrors.h raycast/scene_accelerator.h
    raycast/ray_packets.h
    raycast/refinement.h raycast/seen_triangles.h raycast/shot.h)

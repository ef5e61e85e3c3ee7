"""The complete plan of a config's scene, with all indices."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from . import assets, checks, fires, ids
from .anatomy.skeleton import part_names
from .camera import Intrinsics, camera_of, intrinsics_of, widened
from .flight.pilots import Pilot
from .flight.poses import Flight
from .groups.actors import Actor, measure
from .groups.cast import plan_cast
from .groups.group_checks import check_groups
from .groups.routes import plan_loops
from .groups.site_rules import Land
from .groups.treads import plan_treads
from .land.corridors import Corridor, Corridors
from .land.covers import SOIL, Layer, plan_covers
from .land.ground_maps import Ground, lay_ground
from .land.road_plan import plan_road
from .land.terrain import Terrain, build_terrain
from .land.trails import Place
from .land.trodden import lay_fine_covers
from .plants.density import plan_density
from .plants.halos import with_halos
from .plants.placement import Planting, Shares, Site, place_plants, with_more
from .plants.plant_shapes import slots_of
from .seen_ground import Seen, everywhere, seen_ground
from .sites.crossings import plan_crossings
from .sites.grounds import plan_furrows, plan_grounds
from .sites.layout import lay_out, plantings_of
from .sites.settlement import Settlement, plan_settlements
from .workers import Cores

WATER = "water"


@dataclass(frozen=True)
class World:
    """The scene of a config; plantings of plants and structures by name, material indices by (material, part).

    ground is None if it was not requested.
    """

    config: dict
    intrinsics: Intrinsics
    view_margin_px: int
    terrain: Terrain
    covers: list[Layer]
    plantings: dict[str, Planting]
    plant_indices: dict[str, int]
    fires: list[fires.Fire]
    fire_indices: list[int]
    actors: list[Actor]
    material_indices: dict[tuple[str, str], int]
    pilot: Pilot
    ground: Ground | None

    @property
    def view_intrinsics(self) -> Intrinsics:
        """Intrinsics of a pinhole camera that contains the views of the passes and the lens."""
        return widened(self.intrinsics, self.view_margin_px)

    def camera(self, entry: dict) -> Intrinsics:
        """Intrinsics of one of the config's clips or flights, or of a clip cut from one."""
        return camera_of(entry, self.intrinsics)

    def flight(self, entry: dict) -> Flight:
        """The frames of one of the config's clips or flights; ConfigError if it cannot be flown."""
        return self.pilot.flight(entry)


def plan_world(config: dict, cores: Cores = Cores(), with_ground: bool = False) -> World:
    """Plan the scene of a resolved config; ConfigError if the config is invalid."""
    checks.check_names(config)
    scene, seed = config["scene"], config["seed"]
    checks.check_size(scene)
    checks.check_plants(scene)
    checks.check_paths(scene)
    terrain = build_terrain(scene["terrain"], seed)
    checks.check_road(scene["terrain"], lambda x_m, y_m: terrain.shore_m(x_m, y_m) < 0)
    terrain = terrain.with_road(plan_road(scene["terrain"]["road"], terrain, seed))
    settlements = plan_settlements(scene.get("sites", []), terrain, seed)
    covers = plan_covers(terrain, scene["terrain"], seed, plan_grounds(settlements))
    loops = plan_loops(scene["paths"], terrain, seed)
    check_groups(scene["groups"], loops)
    checks.check_loops(scene, loops)
    cast = plan_cast(scene["groups"], Land(terrain, loops), seed)
    areas = plan_density(terrain, scene["terrain"], seed)
    burning = fires.plan_fires(scene.get("fires", []), terrain)
    treads = plan_treads(scene["groups"], loops, cast.actors)
    places = [Place(site.name, site.middle_m, site.radius_m) for site in settlements]
    treads = replace(treads, strands=[*treads.strands, *plan_furrows(settlements, terrain)], places=places)
    taken = [*cast.corridors, *(fire.clearing for fire in burning)]
    plantings = cores.start(lambda: _plantings(scene, settlements, terrain, areas.shares, taken, seed))
    intrinsics = intrinsics_of(config["camera"])
    pilot = Pilot(config, terrain, cast.actors, intrinsics)
    if with_ground:
        seen, hearths = _seen(config, terrain, pilot), [fire.hearth for fire in burning]
        fine = cores.start(
            lambda: lay_fine_covers(terrain, covers, treads, scene["terrain"], hearths, seed, seen)
        )
        ground = cores.start(lambda: lay_ground(terrain, covers, seen))
    measure(cast.actors, cores)
    standing = plantings()
    return World(
        config=config,
        intrinsics=intrinsics,
        view_margin_px=config["render"]["view_margin_px"],
        terrain=terrain,
        covers=covers,
        plantings=standing,
        plant_indices=ids.plan_plant_indices(list(standing)),
        fires=burning,
        fire_indices=ids.plan_fire_indices(len(standing), len(burning)),
        actors=cast.actors,
        material_indices=ids.plan_material_indices(
            _materials(terrain, covers, standing, burning, cast.actors)
        ),
        pilot=pilot,
        ground=replace(ground(), fine=with_halos(fine(), standing, terrain, seed)) if with_ground else None,
    )


def _plantings(
    scene: dict,
    settlements: Sequence[Settlement],
    terrain: Terrain,
    shares: Shares,
    taken: Sequence[Corridor],
    seed: int,
) -> dict[str, Planting]:
    """Plants, and what is built; both keep off the ground that is taken."""
    corridors = Corridors(taken)
    built = [thing for site in settlements for thing in lay_out(site, terrain, corridors)]
    built += plan_crossings(terrain, corridors)
    feet = [Corridor(thing.point_m[None], thing.foot_m) for thing in built]
    site = Site(terrain, shares, terrain.road_m, Corridors([*taken, *feet]))
    return with_more(place_plants(scene["plants"], site, seed), plantings_of(built, terrain, seed))


def _seen(config: dict, terrain: Terrain, pilot: Pilot) -> Seen:
    """The ground that clips show; all of it where a camera may be moved anywhere."""
    if config["render"]["posed_actors"] == "all":
        return everywhere
    margin_px, usual = config["render"]["view_margin_px"], intrinsics_of(config["camera"])
    return seen_ground(
        terrain,
        (
            (widened(camera_of(entry, usual), margin_px), pilot.flight(entry))
            for entry in (*config["clips"], *config["flights"])
        ),
    )


def _materials(
    terrain: Terrain,
    covers: list[Layer],
    standing: Iterable[str],
    burning: list[fires.Fire],
    actors: list[Actor],
) -> list[tuple[str, str]]:
    """Every (material, part) of the scene, those of the ground and its objects first."""
    names = [SOIL, *(layer.material for layer in covers), *([WATER] if terrain.waters else [])]
    pairs = [(name, "") for name in names]
    for name in standing:
        pairs += slots_of(assets.standing(name))
    if burning:
        pairs += [(fires.MATERIAL, part) for part in fires.PARTS]
    for species in dict.fromkeys(actor.species for actor in actors):
        data = assets.load("species", species)
        pairs += [(data["material"], part) for part in part_names(data)]
    return pairs

/** Coordinates x, y, z of one vertex after another. */
export type Positions = Float64Array | Float32Array | ArrayLike<number>;
export type PairKind = "vertex-face" | "edge-edge";

/** Contacts, or pairs near each other, one after another in each array. */
export interface Contacts {
  count: number;
  /** 0: a vertex and a face; 1: two edges. */
  kind: Uint8Array;
  /** Two numbers each: the vertex and the face, or the two edges. */
  pair: Uint32Array;
  /** Times in [0, 1] of the step, none later than the exact one. */
  time: Float64Array;
  /** Four each: the vertex and the corners of the face, or the ends of both edges. */
  vertices: Uint32Array;
  /** With geometry: six coordinates each, the closest points of the first and of the second primitive. */
  points?: Float64Array;
  /** With geometry: four each, the weights of the vertices in the closest points. */
  weights?: Float64Array;
  /** With geometry: three each, the unit normal; NaN where there is none. */
  normal?: Float64Array;
  /** With geometry: two each, the bounds of the distance. */
  distance?: Float64Array;
  /** With geometry: the relative speed along the normal, in lengths per step. */
  speed?: Float64Array;
}
export interface Contact { kind: PairKind; pair: [number, number]; time: number; vertices: [number, number, number, number]; }
export interface Truncation {
  /** Positions to which the step is free of contact. */
  end: Float64Array;
  heldBack: number;
  inContact: number;
}
export interface Intersections {
  count: number;
  /** 0: an edge and a face; 1: a vertex and a face; 2: two edges. */
  kind: Uint8Array;
  pair: Uint32Array;
}
export interface Limits {
  /** Pairs that may come within this distance are contacts. Default 0. */
  separation?: number;
  /** The accuracy of times, as a length. Default 2^-30. */
  tolerance?: number;
  /** Only pairs that truly touch are contacts, decided exactly. */
  touching?: boolean;
}
export interface CollisionFilter {
  /** Two numbers for each vertex: the bits of its groups, and of the groups that it collides with. */
  groups?: Uint32Array;
  /** One number for each vertex. Vertices of one patch do not collide. */
  patches?: Uint32Array;
  /** Pairs of vertices that do not collide. */
  excluded?: Uint32Array;
}
export interface Statistics { candidates: number; filtered: number; contacts: number; seconds: number; }
/** A force in N and its torque in N m about a point, three numbers each. */
export interface Wrench { force: Float64Array; torque: Float64Array; }
/** The load of the cloth on a body. */
export interface BodyLoad { contact: Wrench; friction: Wrench; pins: Wrench; attachments: Wrench; total: Wrench; }
/** A rotation by a quaternion (x, y, z, w), and then a translation in m. */
export interface Placement { translation: Float64Array; rotation: Float64Array; }
/** The mass and the motion of a free body. */
export interface FreeBodyState {
  /** In kg, with the mass of cloth that is pinned to the body. */
  mass: number;
  /** The centre of mass, in m. */
  centre: Float64Array;
  /** Of the centre of mass, in m/s. */
  velocity: Float64Array;
  /** The angular velocity, in rad/s. */
  spin: Float64Array;
  /** About the centre of mass, in kg m^2/s. */
  angularMomentum: Float64Array;
}
export interface PairVerdicts {
  /** k0, 3 k1, 3 k2, k3 of the signed volume, and the certified bound of the error of each. */
  controlValues: Float64Array;
  errorBounds: Float64Array;
  /** True: the test proves that the pair does not touch. */
  culledBy: { sweptBoxes: boolean; segmentBox: boolean; relativeBoxes: boolean; permanent: boolean; widened: boolean; exact: boolean };
  /** No later than the first contact; undefined if there is certainly none. */
  time: number | undefined;
  /** Why no later time is proven; undefined without a time. */
  reason: string | undefined;
  /** The exact verdict. */
  contact: "never" | "happens" | "undefined";
}

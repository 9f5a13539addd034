export interface HardCase { name: string; placement: string; kind: PairKind; start: Float64Array; end: Float64Array; exact: string; time: number | undefined; }
export interface MethodStage { name: string; pairs: number; milliseconds: number; vertices: Uint32Array; }

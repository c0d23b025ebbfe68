/** The script of the Lift room. */

import { liftRoom } from "./rooms/lift.ts";

export type LiftRoomMaker = typeof liftRoom;

Object.assign(document.currentScript!, { offers: liftRoom });

(()=>{var{make:$}=document.currentScript.shared;var{CanvasPen:Z}=document.currentScript.shared;var{BEHIND:Q,HALO_WIDTH:ee,HATCH_PITCH:te,HATCH_WIDTH:ne,SERIF:se,STYLES:ae,colours:N}=document.currentScript.shared;var{writeNumber:I}=document.currentScript.shared;var{LIGHT:oe,Pen:re,cornersOf:C,textParts:ie,traceCorners:le,traceSegment:B}=document.currentScript.shared;var{counted:k}=document.currentScript.shared;var{along:ce}=document.currentScript.shared;var{tableLonlat:he}=document.currentScript.shared;var{lonLatOf:D}=document.currentScript.shared;var{asCount:z}=document.currentScript.shared;var{Kept:V,filled:q,kernel:de}=document.currentScript.shared;var{CIRCLE_RADIUS:pe,STEP:ue}=document.currentScript.shared;var je=3,Ue=3,Fe=class extends re{#t=[];#e=[];text(e){let[n,t]=[m(this.width),m(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${n}" height="${t}" viewBox="0 0 ${n} ${t}">`,`<title>${Y(e)}</title>`,...this.#t.length>0?[`<defs>${this.#t.join("")}</defs>`]:[],`<rect width="${n}" height="${t}" ${v("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${se}'>`,...this.#e].join(`
`)}
</g>
</svg>
`}path(e,n,t,s){let a=fe(t);if(a==="")return;let o=[];n.hatch!==void 0&&o.push(`fill="url(#${this.#r(n.hatch)})"`),n.fill!==void 0&&o.push(v("fill",s??this.colours[n.fill],n.fillOpacity)),n.stroke!==void 0&&o.push(this.#n(n,s)),this.#e.push(`<path class="${e}" ${o.join(" ")} d="${a}"/>`)}behind(e){this.#s(`opacity="${Q}"`,e)}clipped(e,n){let t=`clip-${this.#t.length}`;this.#t.push(`<clipPath id="${t}"><path d="${fe(e)}"/></clipPath>`),this.#s(`clip-path="url(#${t})"`,n)}discs(e,n,t){let{radius:s,fill:a,rim:o,rimWidth:r,opacity:l}=n,i=m(s-r/2),c=`dots-${this.#t.length}`,h=[];for(let p=0;p<t.length;p+=2)h.push(`<circle cx="${m(t[p])}" cy="${m(t[p+1])}" r="${i}"/>`);this.#t.push(`<g id="${c}">${h.join("")}</g>`);let d=`fill="none" ${v("stroke",this.colours[o],l)} stroke-width="${m(2*r)}"`;this.#e.push(`<use class="${e}-rim" href="#${c}" ${d}/>`),this.#e.push(`<use class="${e}" href="#${c}" ${v("fill",this.colours[a],l)}/>`)}spots(e,n){let t=this.#n(ae["spot-line"]);n.forEach((s,a)=>{let[o,r,l]=[e[3*a],e[3*a+1],e[3*a+2]].map(m),i=s==="transparent"?"":` ${v("fill",s)}`;this.#e.push(`<circle class="spot" cx="${o}" cy="${r}" r="${l}"${i} ${t}/>`)})}lowered(e,n){this.#s(`transform="translate(0 ${m(e)})"`,n)}label(e,n,t,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=ie(e,s.italic??!1).map(i=>i.italic?`<tspan font-style="italic">${Y(i.text)}</tspan>`:Y(i.text)).join(""),r=`paint-order="stroke" ${v("stroke",this.inkOf(s.halo))} stroke-width="${ee}"`,l=`x="${m(n)}" y="${m(t)}" font-size="${s.size}" text-anchor="${a}"`;this.#e.push(`<text ${l} ${v("fill",this.inkOf(s.ink))} ${r}>${o}</text>`)}picture(e,n,t,s,a){let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let r=`x="${m(n)}" y="${m(t)}" width="${m(s)}" height="${m(a)}"`;this.#e.push(`<image ${r} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,n=this.colours[e.stroke??"ink"]){let t=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`,s=m((e.width??1)*this.weight);return`${v("stroke",n,e.strokeOpacity)} stroke-width="${s}"${t}`}#s(e,n){this.#e.push(`<g ${e}>`),n(),this.#e.push("</g>")}fillDisc({x:e,y:n,r:t},s){let a=typeof s=="string"?v("fill",s):`fill="url(#${this.#o(s)})"`;this.#e.push(`<circle ${a} cx="${m(e)}" cy="${m(n)}" r="${m(t)}"/>`)}#o({id:e,stops:n}){let t=n.map(([a,o])=>`<stop offset="${a}" ${v("stop-color",o,1,"stop-opacity")}/>`),s=Object.entries(oe).map(([a,o])=>`${a}="${m((o+(a==="r"?0:1))/2)}"`);return this.#a(e,`<radialGradient id="${e}" ${s.join(" ")}>${t.join("")}</radialGradient>`)}#r(e){let[n,t]=[`hatch-${e}`,te],s=`M0 ${t/2}H${t}${e==="crossed"?`M${t/2} 0V${t}`:""}`,a=`${v("stroke",this.colours.hatch)} stroke-width="${ne}"`,o=`width="${t}" height="${t}" patternUnits="userSpaceOnUse" patternTransform="rotate(-45)"`;return this.#a(n,`<pattern id="${n}" ${o}><path ${a} d="${s}"/></pattern>`)}#a(e,n){return this.#t.includes(n)||this.#t.push(n),e}};function fe(e){let n="";return e({moveTo:(t,s)=>n+=`M${m(t)} ${m(s)}`,lineTo:(t,s)=>n+=`L${m(t)} ${m(s)}`,ellipse(t,s,a,o,r,l,i,c=!1){let[h,d]=[Math.cos(r),Math.sin(r)],p=y=>{let[u,g]=[a*Math.cos(y),o*Math.sin(y)];return[t+u*h-g*d,s+u*d+g*h]};n===""?this.moveTo(...p(l)):this.lineTo(...p(l));let f=Math.ceil(Math.abs(i-l)/Ue),b=`${m(a)} ${m(o)} ${m(r*180/Math.PI)} 0 ${c?0:1}`;for(let y=1;y<=f;++y){let[u,g]=p(l+(i-l)*y/f);n+=`A${b} ${m(u)} ${m(g)}`}},closePath:()=>n+="Z"}),n}function m(e){return I(e,je)}function v(e,n,t=1,s=`${e}-opacity`){let[a,o,r,l=1]=(n.match(/[\d.]+/g)??[]).map(Number),i=l*t,c=i===1?"":` ${s}="${m(i)}"`;return`${e}="rgb(${a}, ${o}, ${r})"${c}`}function Y(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var S={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},M=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,We=new Set(S.missing),A=e=>We.has(e.trim().toLowerCase()),Ge=new RegExp(`\\0|[^\\x00-\\x7f${S.western}]|[^\\x00-\\x7f]{3}`),Be="぀";function X(e,n=!1){let[t,s]=["lon","lat"].map(a=>{let[o,r]=[S[a],S[`unsure_${a}`]],c=[h=>o.includes(h),(h,d)=>o.some(p=>d.includes(p)||p>Be&&h.includes(p)),(h,d)=>d.length>0&&d.every(p=>r.includes(p))].slice(0,n?2:3).map(h=>e.filter(d=>h(d.trim().toLowerCase(),Ve(d)))).find(h=>h.length>0);return c?.length===1?c[0]:null});return t===null||s===null||t===s?null:[t,s]}function Ve(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(t=>t!==""&&!S.beside.includes(t))}var qe=new RegExp(`^(?:${S.lettered})$`,"iu"),Ye=new RegExp(`[${S.printed}${S.unseen}]`,"gu");function U(e){return e.replace(Ye,t=>S.typed[S.printed.indexOf(t)]??"").trim().replace(/\s+/g," ")}var Xe=new Map(Object.entries({...S.compass,O:"O"}).flatMap(([e,n])=>[e,...n.toLowerCase().split(" ")].map(t=>[t,e]))),Se=e=>Xe.get(e.length>1?e.toLowerCase():e),ge="[0-9]+(?:[.,][0-9]*)?",Ke=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${ge})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${ge})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function Je(e){let n=e.length>200?null:Ke.exec(U(e))?.groups;if(!n)return null;let{before:t,after:s,sign:a}=n,o=[n.degrees,n.minutes,n.seconds].filter(d=>d!==void 0),r=o.map(d=>d.replace(",",".").replace(/\.$/,"")),l=t??s?Se(t??s):"",i=o.slice(0,-1).every(d=>/^[0-9]+$/.test(d));return l===void 0||t&&s||l&&a||!i||r.slice(1).some(d=>Number(d)>=60)?null:{degrees:(l==="W"||l==="S"||a==="-"?-1:1)*(l==="O"?NaN:Ze(r)),point:l}}function Ze(e){if(e.length===1)return Number(e[0]);let n=10**(e[e.length-1].split(".")[1]?.length??0);return e.reduce((t,s)=>60*t+Math.round(Number(s)*n),0)/(n*60**(e.length-1))}var ke=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Qe=/^[-+]?0[0-9]/;function et(e){let[n,t]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return n.length===1&&t.length===1?[n[0],t[0]]:e.length===2?[e[0],e[1]]:null}function tt(e,n,t){let[s,a]=[me(e,n,"longitude"),me(e,t,"latitude")];return Ee(Ae(s,a),e.wrong)}function Ee(e,n){for(let t=0;t<e.length/2;++t){let[s,a]=[e[2*t],e[2*t+1]];n.has(t)||(Math.abs(a)>90?n.set(t,`latitude ${a} is outside [-90, 90]; is it the longitude, or not in degrees?`):Math.abs(s)>360&&n.set(t,`longitude ${s} is outside [-360, 360]`))}return e}function nt(e,n,t){let s=Re(e.columns),a=[n,t].map(o=>Me(e,o,e.columns.get(o),r=>Le(r,s)?"may have a decimal mark or thousands; write thousands without one":De(r)));return Ae(a[0],a[1])}function st(e,n){let t=Re(e),s=l=>M.test(l)&&!Qe.test(l)&&!Le(l,t),a=l=>A(l)||s(l.trim()),o=[...e].filter(([l,i])=>!n.has(l)&&i.every(a)&&!i.every(A)),r=l=>A(l)?NaN:Te(l.trim());return new Map(o.map(([l,i])=>[l,Float64Array.from(i,r)]))}function Re(e){let t=[...e.values()].flatMap(s=>s.filter(a=>/[.,]/.test(a))).map(s=>s.trim()).filter(s=>M.test(s)&&!ke.test(s));return[...new Set(t.map(Pe))].join("")||"."}var Pe=e=>e.includes(",")?",":".",Le=(e,n)=>ke.test(e)&&Pe(e)!==n;function Ae(e,n){return Float64Array.from({length:2*e.length},(t,s)=>(s%2===0?e:n)[s>>1])}var Te=e=>Number(e.replace(",","."));function me(e,n,t){return Me(e,t,at(e,n,t),s=>{let a=M.test(s)?null:Je(s);if(a===null)return De(s);let o=a.point===""?t:/[NS]/.test(a.point)?"latitude":"longitude";return o!==t?`is a ${o}`:a.point==="O"?"has an O, which is east in German and west in French; write E or W in its place":a.degrees})}function at({columns:e},n,t){let[s,a]=[e.get(n),[...e.keys()]],o=a[a.indexOf(n)+1]??"";if(!qe.test(o))return s;let r=e.get(o).map(c=>A(U(c))?"":U(c)),l=r.filter(Boolean).map(c=>Se(c)??"?");return!(l.length>0&&l.every(c=>(t==="latitude"?"NS":"EWO").includes(c)))||s.some(c=>U(c).includes("-")&&!A(c))?s:s.map((c,h)=>A(c)?"":`${c} ${r[h]}`.trim())}var De=e=>M.test(e)?Te(e):NaN;function Me({wrong:e},n,t,s){return Float64Array.from(t,(a,o)=>{let r=a.trim(),l=s(r);if(typeof l=="number"&&Number.isFinite(l))return l;let i=typeof l=="string"?l:"is not a number";return e.has(o)||e.set(o,`the ${n} ${A(r)?"is missing":`'${r}' ${i}`}`),NaN})}var ot=[",",";","	","|"],rt=50,it=20,W=/\r\n|\n|\r/,lt=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function ct(e){let n=lt.exec(e)?.[0]??"",t=e.slice(n.length),s=ht(t),a=n.split(W).length,r=[...s===null?dt(t,a):pt(t,s,a)].filter(({cells:u})=>u.some(g=>g.trim()!==""));if(r.length===0)throw new _("the table is empty: there is not even a line with the names of the columns");let{names:l,data:i}=ut(r),c=i.length<r.length,h=l.find((u,g)=>u!==""&&l.indexOf(u)!==g);if(h!==void 0)throw new _(`there are several columns with the name '${h}'`);let d=l.map(()=>[]),p=new Map,f=l.reduce((u,g,w)=>g===""?u:w+1,0);i.forEach(({cells:u},g)=>{let w=u.length>=f&&u.slice(l.length).every(P=>P===""),[O,G]=[`${u.length} field${u.length===1?"":"s"}`,`${l.length} columns`];w||p.set(g,`has ${O}, but there are ${G}`),d.forEach((P,T)=>P.push(u[T]??""))});let y=l.map((u,g)=>[u||`column_${g+1}`,d[g]]).filter(([,u],g)=>l[g]!==""||u.some(w=>w!==""));return{columns:new Map(y),count:i.length,isHeaded:c,lines:i.map(({line:u})=>u),wrong:p}}function ht(e){let n=e.split(W,rt).filter(i=>i.trim()!==""),t=n.map(i=>i.replace(/"[^"]*"/g,"")),a=ot.map(i=>({mark:i,widths:t.map(c=>c.split(i).length)})).filter(({widths:i})=>Math.max(0,...i)>1),o=a.filter(({widths:i})=>new Set(i).size===1),r=[...new Set(n.map(i=>i.trim().split(/\s+/).length))];if(a.length===0||o.length===0&&r.length===1&&r[0]>1)return null;let l=({widths:i})=>Math.max(...i.map(c=>c>1?1e6*i.filter(h=>h===c).length+c:0));return(o.length>0?o:a).reduce((i,c)=>l(c)>l(i)?c:i).mark}function*dt(e,n){for(let[t,s]of e.split(W).entries())yield{cells:s.trim().split(/\s+/),line:n+t}}function*pt(e,n,t){let s=`[^"\\${n}\\r\\n][^\\${n}\\r\\n]*`,a=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${s})?)(\\${n}|\\r\\n|\\n|\\r|$)`,"y"),[o,r,l]=[[],t,t];for(;a.lastIndex<e.length;){let i=a.exec(e);if(i===null){let c="a field begins with a quotation mark but does not end with one";throw new _(`line ${r}: ${c}; inside such a field write it twice`)}i[1]!==void 0&&(l+=i[1].split(W).length-1),o.push(i[1]?.replaceAll('""','"')??i[2]??""),i[3]!==n&&(yield{cells:o,line:r},[o,r]=[[],++l])}o.length>0&&(yield{cells:[...o,""],line:r})}function ut(e){let n=e.slice(0,it).map(({cells:c})=>c.map(h=>h.trim())),t=n.map(c=>c.filter(h=>h!=="")),s=c=>M.test(c),a=t.findIndex((c,h)=>X(c)!==null&&(h===0||!c.some(s))),o=t.findIndex(c=>c.length>1),r=Math.max(0,a>=0?a:o);return a<0&&2*t[r].filter(s).length>t[r].length?{names:n[r].length===2?["lon","lat"]:n[r].map((c,h)=>`column_${h+1}`),data:e.slice(r)}:{names:n[r],data:e.slice(r+1)}}function ft(e,{places:n,names:t=null,values:s=new Map}){let a=i=>Object.is(i,-0)?"-0.0":Number.isFinite(i)?`${i}`:"",o=i=>/[",\r\n]/.test(i)?`"${i.replaceAll('"','""')}"`:i,r=[...e,...t===null?[]:["name"],...[...s.keys()].map(o)],l=Array.from({length:n.length/2},(i,c)=>{let h=t===null?[]:[o(t[c])],d=[...s.values()].map(p=>a(p[c]));return[a(n[2*c]),a(n[2*c+1]),...h,...d].join(",")});return`${[r.join(","),...l].join(`
`)}
`}var _=class extends Error{columns;constructor(e,n=[]){super(e),this.columns=n}};function gt(e){let n=bt(e),t=L(n,"type")==="Feature"?[n]:L(n,"features");if(!Array.isArray(t))throw new _("the file is not a GeoJSON FeatureCollection of points");let s=new Map,a=t.map((c,h)=>{let d=yt(c);return typeof d=="string"&&s.set(h,d),typeof d=="string"?[NaN,NaN]:d}),o=Ee(Float64Array.from(a.flat()),s),r=t.map(c=>L(c,"properties")),l=new Set(r.flatMap(c=>Object.keys(c??{}))),i=new Map([...l].map(c=>[c,r.map(h=>mt(L(h,c)))]));return{places:o,table:{columns:i,count:t.length,isHeaded:!0,lines:[],wrong:s}}}function mt(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function L(e,n){return typeof e=="object"&&e!==null?e[n]:void 0}function bt(e){try{return JSON.parse(e)}catch(n){let t=e.split(`
`).map(s=>s.replace(/^[\x1e \t\r]+|[\x1e \t\r]+$/g,""));try{if(!t[0].endsWith("}"))throw n;return{features:t.filter(s=>s!=="").map(s=>JSON.parse(s))}}catch{throw new _(`the file is not JSON: ${n instanceof Error?n.message:String(n)}`)}}}function yt(e){let n=L(e,"geometry"),[t,s]=[L(n,"type"),L(n,"coordinates")],a=t==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(t!=="Point"&&!a)return`a Point is needed, not ${typeof t=="string"?t:"no geometry"}`;let o=a?s[0]:s,r=Array.isArray(o)?o.slice(0,2):[];return r.length===2&&r.every(Number.isFinite)?r:`a Point has two or three coordinates, not ${JSON.stringify(o)}`}var be=1e6;async function wt(e,n,t,s){let{text:a,guess:o}=xt(await vt(n),e),r=/^[\s\x1e]*[{[]/.test(a);if(r&&t==="plane")return{room:"globe"};let l=r?gt(a):_t(a,t,s);if("room"in l)return l;let{places:i,table:c,axes:h=[]}=l,{count:d,wrong:p}=c;if(d===0)throw new _("there are no points");if(d>be){let g=`the page takes up to ${k(be)}; for more there is the Python library`;throw new _(`there are ${k(d)} points; ${g}`)}let f=p.size===0?"":$t(c);if(p.size===d)throw new _(f);let b=(g,w)=>!p.has(w),y=new Map([...c.columns].map(([g,w])=>[g,w.filter(b)])),u=[...y.keys()].find(g=>g.trim().toLowerCase()==="name")??"";return{file:e,places:i.filter((g,w)=>b(0,w>>1)),names:y.get(u)??null,values:st(y,new Set([...h,u])),leftOut:p.size,wrong:f,guess:o}}function $t({count:e,lines:n,wrong:t}){let s=[...t.keys()].reduce((l,i)=>Math.min(l,i)),a=t.size===e?"No row":`${k(t.size)} of ${k(e)} rows`,o=n.length===0?"":`, on line ${k(n[s])}`,r=t.size===e?"can":"cannot";return`${a} ${r} be placed. Row ${k(s+1)}${o}: ${t.get(s)}`}function _t(e,n,t){let s=ct(e),a=[...s.columns.keys()],o=s.isHeaded?X(a,!0):null,r=t??(n==="lonlat"?X(a):et(a));if(r===null&&o!==null)return{room:"globe"};if(r===null)throw new _("the table has no two columns of coordinates",a);let l=(n==="lonlat"?tt:nt)(s,...r),i=[...s.wrong.keys()].filter(c=>Number.isFinite(l[2*c]+l[2*c+1]));return n==="lonlat"&&o===null&&2*i.length>s.count?{room:"lift",columns:r}:{places:l,table:s,axes:r}}async function vt(e){if(!(e[0]===31&&e[1]===139))return e;try{let n=new Blob([e.slice()]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(n).arrayBuffer())}catch{throw new _("the compressed file is damaged")}}function xt(e,n){let t=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(t)?"utf-16le":/^(\xfe\xff|\0)/.test(t)?"utf-16be":null,a=(c,h)=>{try{let d=new TextDecoder(c,{fatal:!0}).decode(e);return/^\s*</.test(d)||h.test(d)?null:d}catch{return null}},o=a(s??"utf-8",/\0/);if(o!==null)return{text:o,guess:null};let r=s===null?a("windows-1252",Ge):null;if(r!==null)return{text:r,guess:"windows-1252"};let l=/^[\w.-]+$/.test(n)?n:`"${n}"`,i="neither a picture nor a table in text that the page can read";throw new _(`${i}; to make a page of it, type: stereodel web ${l}`)}async function Oe(e,n,t,s,a){if(e.type.startsWith("image/"))return t.pass("globe",e);let{messages:o}=t,r=`${e.name}:`,l=i=>`${i}${/[.?!]$/.test(i)?"":"."} Nothing has changed.`;try{let i=await wt(e.name,new Uint8Array(await e.arrayBuffer()),n,a);if("room"in i)return t.pass(i.room,e,i.columns);let{leftOut:c,wrong:h,guess:d}=i,p=()=>{o.close(),s(i),d!==null&&o.show(r,`it does not say its encoding; read as ${d}.`)};if(c===0)return p();let f=c===1?"this row":`these ${k(c)} rows`;o.show(r,l(h),{words:`Open without ${f}`,act:p})}catch(i){if(!(i instanceof _))throw i;let c=(...h)=>Oe(e,n,t,s,h);i.columns.length>1?St(e.name,i.columns,n,o,c):o.show(r,l(i.message))}}function St(e,n,t,s,a){let o=t==="lonlat"?["Longitude","Latitude"]:["x","y"],r=o.map((c,h)=>{let d=$("select","",...n.map(p=>$("option","",p)));return d.selectedIndex=Math.min(h,n.length-1),d}),l={words:"Open",act:()=>a(r[0].value,r[1].value)},i=o.map((c,h)=>$("label","field column",`${c} `,r[h]));s.show(`Which columns of ${e}?`,"",l,i)}var kt=7;function Et(e,n="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?Rt:Pt(a,n);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var Rt={type:"Polygon",coordinates:[[...C(-180,-90,180,90),[-180,-90]]]};function Pt(e,n){let t=Lt(e.flatMap((l,i)=>ce(l,e[(i+1)%e.length])),n),s=Math.round((t[t.length-1][0]-t[0][0])/360),a=s===0?t:At(t,s),o=l=>Number(l.toFixed(kt)),r=Tt(a).map(l=>[l.map(([i,c])=>[o(i),o(c)])]);return r.length===1?{type:"Polygon",coordinates:r[0]}:{type:"MultiPolygon",coordinates:r}}function Lt(e,n){let t=he(Float64Array.from([...e,e[0]].flatMap(D)),n),s=[];for(let a=0;a<t.length;a+=2){let o=s[s.length-1]?.[0]??t[a];s.push([t[a]+360*Math.round((o-t[a])/360),t[a+1]])}return s}function At(e,n){let t=n>0?90:-90,s=n>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([d])=>d>=a),r=Ne(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),l=s.slice(Math.max(o,0),-1).map(([d,p])=>[d-a-180,p]),i=s.slice(0,Math.max(o,0)).map(([d,p])=>[d-a+180,p]),c=[[-180,r],...l,...i,[180,r]],h=n>0?c:c.reverse();return[...h,[h[h.length-1][0],t],[h[0][0],t],h[0]]}function Ne(e,n,t){return e[0]===n[0]?e[1]:e[1]+(t-e[0])/(n[0]-e[0])*(n[1]-e[1])}function Tt(e){let n=e.map(([o])=>o),t=Math.floor((Math.min(...n)+180)/360),s=Math.ceil((Math.max(...n)+180)/360),a=[];for(let o=t;o<Math.max(s,t+1);++o){let r=e.slice(0,-1).map(([i,c])=>[i-360*o,c]),l=ye(ye(r,-180,1),180,-1);l.length>2&&a.push([...l,l[0]])}return a}function ye(e,n,t){let s=[];return e.forEach((a,o)=>{let r=e[(o+1)%e.length],[l,i]=[t*(a[0]-n)>=0,t*(r[0]-n)>=0];l&&s.push(a),l!==i&&a[0]!==n&&r[0]!==n&&s.push([n,Ne(a,r,n)])}),s}var we=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),$e=2**15,Dt=class{width;height;texels;levels;constructor(e,n){if(this.width=z(n,"width",2,2**20),this.height=n/2,e.length!==4*this.width*this.height){let a=`four for each of ${n} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new V(Mt(e));let t=de().run(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,we];this.levels=new V(q(Uint8Array,t,"raster_levels",...s))}warp(e,n){return this.painted(e,[-1,1,2/n,2/n],n,n)}painted(e,n,t,s,a=!0){z(t,"width",1,$e),z(s,"height",1,$e);let o=e.inverse(),r=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),i=[...[this.texels,this.levels,this.width,this.height,we],r,Float64Array.of(...n),t,s,a?1:0];return q(Uint8ClampedArray,4*t*s,"warp_raster",...i)}};function Mt(e){let n=Uint8Array.from(e);for(let t=0;t<n.length;++t)t%4!==3&&(n[t]=Math.floor((n[t]*n[t|3]+127)/255));return n}var Ot=4096,Nt=2,It=.25,[Ct,zt]=[.6,120],Ht=.01;async function jt(e,n,t){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>Ht){let l=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;n.show(`${e.name}:`,`the picture ${l??"cannot be read"}. Nothing has changed.`);return}let a=Math.round(Math.min(s.width,Ot)/2),o=$("canvas",{width:2*a,height:a}),r=o.getContext("2d",{willReadFrequently:!0});r.drawImage(s,0,0,o.width,o.height),s.close(),n.close(),t(new Ut(e.name,r.getImageData(0,0,o.width,o.height)))}var Ut=class{name;#t;#e;letters;constructor(e,n){this.name=e,this.#t=new Dt(n.data,n.width),this.#e=Gt(n);let t=[0,0,0];for(let i=0;i<n.data.length;++i)i%4<3&&(t[i%4]+=n.data[i]);let s=t.map(i=>4*i/n.data.length),a=.3*s[0]+.59*s[1]+.11*s[2]>zt,o=s.map(i=>Math.round(i+Ct*((a?255:0)-i))),[r,l]=a?["27, 27, 27","171, 67, 0"]:["255, 255, 255","245, 160, 98"];this.letters={ink:`rgb(${r})`,accent:`rgb(${l})`,halo:`rgb(${o.join(", ")})`}}draw(e,n,t,s){let a=s&&this.#e===null?It:Math.min(Nt,devicePixelRatio),o=Math.max(1,Math.ceil(2*n.r*a)),r=s&&this.#e!==null?this.#e(t,o):this.#n(t,o);e.clipped(l=>l.ellipse(n.x,n.y,n.r,n.r,0,0,2*Math.PI),()=>e.picture(r,n.x-n.r,n.y-n.r,2*n.r,2*n.r))}#n(e,n){let t=$("canvas",{width:n,height:n}),s=new ImageData(this.#t.painted(e,[-1,1,2/n,2/n],n,n,!1),n,n);return t.getContext("2d").putImageData(s,0,0),t}},Ft=`#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`,Wt=`#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D picture;
uniform mat3 left, right;
uniform float magnification;
out vec4 colour;
const float PI = 3.14159265358979;
void main() {
  float square = dot(place, place);
  vec3 seen = vec3(place, sqrt(max(0.0, 1.0 - square)));
  vec3 v = seen * left;
  float s = magnification, up = 1.0 + v.z, down = 1.0 - v.z;
  vec3 w = vec3(2.0 * s * v.xy, up - s * s * down) / (up + s * s * down) * right;
  vec2 at = vec2(atan(w.y, w.x) / (2.0 * PI) + 0.5, 0.5 - asin(clamp(w.z, -1.0, 1.0)) / PI);
  vec2 dx = dFdx(at), dy = dFdy(at);
  dx.x -= round(dx.x);
  dy.x -= round(dy.x);
  colour = square <= 1.02 ? textureGrad(picture, at, dx, dy) : vec4(0.0);
}`;function Gt(e){let n=$("canvas"),t=n.getContext("webgl2",{antialias:!1,depth:!1,alpha:!0});if(t===null||t.getParameter(t.MAX_TEXTURE_SIZE)<e.width)return null;let s=t.createProgram();for(let[a,o]of[[t.VERTEX_SHADER,Ft],[t.FRAGMENT_SHADER,Wt]]){let r=t.createShader(a);t.shaderSource(r,o),t.compileShader(r),t.attachShader(s,r)}return t.linkProgram(s),t.getProgramParameter(s,t.LINK_STATUS)?(t.useProgram(s),t.bindTexture(t.TEXTURE_2D,t.createTexture()),t.texImage2D(t.TEXTURE_2D,0,t.RGBA,t.RGBA,t.UNSIGNED_BYTE,e),t.generateMipmap(t.TEXTURE_2D),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,t.LINEAR_MIPMAP_LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,t.REPEAT),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,t.CLAMP_TO_EDGE),({left:a,right:o,magnification:r},l)=>{n.width!==l&&(n.width=n.height=l),t.viewport(0,0,l,l);for(let[i,{matrix:c}]of Object.entries({left:a,right:o}))t.uniformMatrix3fv(t.getUniformLocation(s,i),!0,new Float32Array(c));return t.uniform1f(t.getUniformLocation(s,"magnification"),1/r),t.drawArrays(t.TRIANGLES,0,3),n}):null}var R={ink:"ink",halo:"paper",size:14},_e={...R,size:24,align:"center"},ve={...R,ink:"ink-2",size:13,align:"center"},H=286,F=270,E=20,j=11;function Ie(e,n){let t=e.map(r=>r.bar?Bt(r):r.circles?Vt(r):qt(r)),s=Math.max(1,Math.min(t.length,Math.floor(n/H))),a=[],o=new Array(s).fill(0);for(let r of t){let l=o.indexOf(Math.min(...o));a.push({block:r,x:Math.max(0,(n-s*H+H-F)/2)+l*H,y:o[l]}),o[l]+=r.height}return{height:Math.max(...o),draw:(r,l,i)=>a.forEach(c=>c.block.draw(r,l+c.x,i+c.y))}}function Bt({title:e,bar:n=[],ticks:t=[],missing:s}){return{height:(s?4.2:3.2)*E,draw(a,o,r){a.label(e,o,r+.7*E,R);let[l,i]=[r+E,r+E+j],c=(h,d,p,f)=>a.draw("swatch",b=>le(b,C(h,p,d,p+j)),f);n.forEach((h,d)=>c(o+F*d/n.length,o+F,l,h));for(let[h,d]of t){let p=o+F*h;a.draw("tick",b=>B(b,[p,i],[p,i+4]));let f=h<.04?"left":h>.96?"right":"center";a.label(d,p,i+18,{...R,align:f})}s&&(c(o,o+2*j,i+27,s[1]),a.label(s[0],o+2*j+8,i+37,R))}}}function Vt({title:e,circles:n=[],ink:t}){let s=Math.max(...n.map(([o])=>o)),a=1.3*E+2*s;return{height:a+E,draw(o,r,l){o.label(e,r,l+.7*E,R);let i=l+a,c=-1/0;for(let[h,d]of n){o.spots([r+s,i-h,h],[t??"transparent"]);let p=i-2*h;c=Math.max(p,c+15);let f=[[r+s,p],[r+2*s,p],[r+2*s+12,c]];o.draw("tick",b=>{B(b,f[0],f[1]),b.lineTo(...f[2])}),o.label(d,f[2][0]+4,c+4.5,R)}}}}function qt({title:e,ink:n}){return{height:E,draw(t,s,a){t.spots([s+6,a+10,5],[n??"transparent"]),t.label(e,s+20,a+14.5,R)}}}function Yt(e){return e.map(({title:n,ticks:t,circles:s})=>[n,...(t??s??[]).map(([,a])=>a)].join(" ")).join("; ")}function Ce(e){let{width:n,paint:t,owner:s}=e;if(!s)return e;let a=xe(s.title,1.9*n/_e.size),o=a.length*30+(a.length>0?6:0),r=s.legend?.length?Ie(s.legend,n):null,l=o+e.height+8,i=xe(s.source,2.1*n/ve.size),c=l+(r?.height??0);return{...e,title:s.title?`${s.title}. ${e.title}`:e.title,height:c+(i.length>0?i.length*17+10:0),paint(h){a.forEach((d,p)=>h.label(d,n/2,26+30*p,_e)),h.lowered(o,()=>t(h)),r?.draw(h,0,l),i.forEach((d,p)=>h.label(d,n/2,c+14+17*p,ve))}}}function xe(e,n){let t=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=t[t.length-1];a!==void 0&&a.length+s.length<n?t[t.length-1]=`${a} ${s}`:t.push(s)}return t}var Xt=`from dataclasses import replace

import numpy as np
from stereodel import SphereCircle, SphericalVoronoi, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import DotStyle, LineStyle, View, as_color
from stereodel.globe import Globe, Panel, panels
from stereodel.io import read_points

RED, WASH = LineStyle("#d55e00", 1.8), "#d55e0021"
[!bubble] focus = {focus}
[!bubble] lens = fisheye(focus, magnification={magnification})
[bubble] taken, filled = SphereCircle.around({taken}), SphereCircle.around({filled})
[bubble] lens = bubble_to_bubble(taken, filled)
[places] places = {places}


def earth():
    globe = Globe(ocean="#dde9f1", limb=LineStyle("#4d4d4d", 1.3){latitude})
[picture]     globe.add_raster({picture})
[!picture land]     globe.add_land(color="#f4eddd", resolution="{resolution}")
[!picture land]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[graticule]     globe.add_graticule({step}, style=LineStyle("#a9b5be", 0.5))
[tissot]     globe.add_tissot({step}, {radius}, color="#40546629", style=LineStyle("#405466", 0.6))
[places cells]     cells = SphericalVoronoi.from_lonlat(places{latitude})
[places cells]     globe.add_cells(cells, style=LineStyle("#1b1b1b", 1.1))
[places]     globe.add_points(places, style=DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6))
[pointed]     globe.add_circles([SphereCircle.around({pointer}, {radius})], color=WASH, style=RED)
    return globe


[!bubble] globe = earth()
[!bubble] globe.add_points([focus], style=DotStyle("#fdfcfa", 5.9, RED.color, 1.8))
[!bubble] globe.add_labels([focus], ["focus"], offset=(9.0, 7.0), color="#ab4300", font="italic", size=15.0)
[!bubble] page = globe.page(lens, View({view}), width={width})
[bubble] before, after = earth(), earth()
[bubble] before.add_circles([taken], color=WASH, style=RED, name="rim")
[bubble] after.add_circles([taken], color=None, style=RED, name="rim")
[bubble] page = panels([Panel(before, None, View({before})), Panel(after, lens, View({view}))], width={width})
[bubble] page = replace(page, items=tuple(sorted(page.items, key=lambda item: item.name == "rim")))  # over the limb
replace(page.shaded(0.7), background=as_color("#fdfcfa")).save("globe.svg")
`,Kt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble
from stereodel.drawing import DotStyle, LineStyle, Polylines, Scene, Sketch, View

points = {points}
low, high = {corners}  # of the sheet
middle, diagonal = (low + high) / 2, np.hypot(*(high - low)) or 1.0
corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
sheet, view = PlanarDelaunay(points), View({view})
width, height, scale, contact = {width}, {height}, {scale}, np.array([{contact}])  # scale: of a diagonal
INK, GRAY, RED = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#d55e00", 1.8)
HULL, SIDE, LIMB = LineStyle("#6d8598", 1.3), LineStyle("#7b7b7b", 1.3), LineStyle("#4d4d4d", 0.7)
PAPER, RAY, DOT = "#fdfcfa", LineStyle("#d55e00", 0.8, (5.0, 4.0)), DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6)
sketch = Sketch()


def in_plane(xy):
    """Where places of the sheet are on the picture, before they are lifted."""
    uv = scale * (xy - middle) / diagonal
    return contact + view.project(np.concatenate([uv, 0 * uv[..., :1]], axis=-1))


[seeing facets] def hatch(chosen):
[seeing facets]     """Lines 45° steep, 6 points apart, where places of the picture are chosen."""
[seeing facets]     reach = np.hypot(width, height) / 2
[seeing facets]     along, across = np.arange(-reach, reach), np.arange(-reach, reach, 6.0)[:, None]
[seeing facets]     places = np.stack([along - across, along + across], axis=-1) / np.sqrt(2) + [width / 2, height / 2]
[seeing facets]     row, end = np.nonzero(np.diff(chosen(places), axis=1, prepend=False, append=False))
[seeing facets]     ends = places[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[seeing facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[flat seeing facets] def outside(places):
[flat]     axes = np.linalg.inv(view.project(np.eye(3)[:2]))
[flat]     xy = (places - contact) @ axes * diagonal / scale + middle
[flat]     return ((low <= xy) & (xy <= high)).all(axis=-1) & (sheet.find_simplex(xy.reshape(-1, 2)).reshape(xy.shape[:2]) < 0)


[flat] sketch.add_polygon(in_plane(corners), name="sheet", color="#9db4c847")
[flat seeing facets] hatch(outside)
[flat seeing facets] sketch.add_edges(in_plane(points), sheet.convex_hull, name="hull", style=HULL)
[flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="delaunay", style=INK)
[flat cells facets] sketch.add_segments(in_plane(PlanarVoronoi(sheet).segments((*low, *high))[0]), name="voronoi", style=GRAY)
[flat] sketch.add_polyline(in_plane(corners), closed=True, name="side", style=SIDE)
[flat] images = in_plane(points)
[flat pair] sketch.add_segment(*images[[{pair}]], name="span", style=RED)
[flat] sketch.add_points(images, name="sites", style=DOT)
[!flat] radius = scale / (4 * np.tan(np.radians({corner}) / 2))
[!flat] projection, center = Stereographic((-90, 90), radius=radius), np.array([0.0, 0.0, -radius])


[!flat] def lifted(xy):
[!flat]     return projection.inverse(scale * (xy - middle) / diagonal)


[!flat] def outside(places):
[!flat]     axes = view.raised((places - contact - view.project(center)) / radius).reshape(-1, 3)
[!flat]     chosen, seen = np.zeros(len(axes), dtype=bool), np.isfinite(axes[:, 2])
[!flat]     xy = projection.forward(axes[seen] @ view.matrix) * diagonal / scale + middle
[!flat]     chosen[seen] = sheet.find_simplex(np.nan_to_num(xy, nan=1e300, posinf=1e300, neginf=-1e300)) < 0
[!flat]     return chosen.reshape(places.shape[:2])


[!flat] xyz = lifted(points)
[!flat] front, glass, span = (Scene(radius=radius, center=center, style=style, limb=LIMB) for style in ("solid", "glass", "none"))
[!flat seeing facets] uv = (points - middle) * 2.0 ** -np.round(np.log2(diagonal))  # rays that are exact
[!flat seeing facets] hull = SphericalDelaunay(np.column_stack([2 * uv, 1 - (uv**2).sum(axis=1)]))
[!flat seeing facets] closing = hull.simplices[in_bubble(*hull.points[hull.simplices].swapaxes(0, 1), (0, 0, -1)) >= 0]
[!flat seeing facets] front.add_edges(xyz, closing[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), name="hull", style=HULL)
[!flat] sketch.add_items(item for item in front.layout(view, at=contact) if item.name in {shown})
[!flat seeing facets] hatch(outside)
[!flat area] ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
[!flat area] through = lifted(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
[!flat area] sides = [SphereArc(SphereCircle.through(*three), three[0], three[2]) for three in through]
[!flat area] glass.add_region(sides, name="sheet", color="#9db4c847")
[!flat triangles] glass.add_edges(xyz, sheet.edges, name="delaunay", style=INK)
[!flat area] glass.add_arcs(sides, name="side", style=SIDE)
[!flat] sketch.add_items(item for item in glass.layout(view, at=contact) if item.name not in ("ball", "limb"))
[!flat cells facets] steps = np.stack([arc.sample(65) for arc in SphericalVoronoi(xyz).ridge_arcs()], axis=1)
[!flat cells facets] xy = projection.forward(steps) * diagonal / scale + middle
[!flat cells facets] inside = ((low <= xy) & (xy <= high)).all(axis=-1) & (view.depth(steps) >= 0)
[!flat cells facets] pieces = np.stack([steps[:-1], steps[1:]], axis=2)[inside[:-1] & inside[1:]].reshape(-1, 3)
[!flat cells facets] lines = contact + view.project(center + radius * pieces)
[!flat cells facets] sketch.add_items([Polylines(lines, np.arange(0, len(lines) + 1, 2), GRAY.color, GRAY.width, "voronoi")])
[!flat] images = contact + view.project(center + radius * xyz)
[!flat] sketch.add_points(images[view.depth(xyz) >= 0], name="sites", style=DOT)
[!flat] sketch.add_polygon(in_plane(corners), name="plane", color="#9db4c819")
[!flat] sketch.add_polyline(in_plane(corners), closed=True, name="frame", style=LIMB)
[!flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="flat", style=LineStyle("#1b1b1b61", 1.1))
[!flat] for arm in ([4.5, 0.0], [0.0, 3.5]):
[!flat]     sketch.add_segment(contact - arm, contact + arm, name="contact", style=LineStyle("#1b1b1b", 1.0))
[!flat pair] span.add_edges(xyz, [[{pair}]], name="span", style=RED)
[!flat pair] sketch.add_items(span.layout(view, at=contact))
[!flat pole] pole = contact + view.project(2 * center)
[letters] for site, letter in zip([{pair}], "PQ"):
[letters]     above = in_plane(points[site])
[!flat letters rays pole]     sketch.add_segment(pole, above, name="ray", style=RAY)
[!flat letters rays !pole]     sketch.add_segment(images[site], above, name="ray", style=RAY)
[letters !flat]     sketch.add_points(above, name="shadow", style=DotStyle(PAPER, 2.8, RED.color, 1.2))
[letters]     sketch.add_points(images[site], name="held", style=DotStyle(RED.color, 3.7, PAPER, 1.0))
[letters]     sketch.add_label(above, f"\${letter}$", (0.0, 9.0), valign="baseline", size=17.0, color="#ab4300")
[!flat pole] sketch.add_points(pole, name="pole", style=DotStyle("#1b1b1b", 2.3, PAPER, 0.6))
sketch.page((0, width, 0, height), width=width, background=PAPER).shaded(0.33).save("lift.svg")
`,Jt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, PlaneLine, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, fisheye, in_bubble, lonlat_to_xyz
from stereodel.data import airports, cities, stars
from stereodel.drawing import DotStyle, Fill, LineStyle, Scene, Sketch, View, as_color
from stereodel.io import read_points
from stereodel.triangulation import planar_part

lonlat = {sites}
delaunay = SphericalDelaunay.from_lonlat(lonlat)
points, pole, view = delaunay.points, lonlat_to_xyz(({pole})), View({view})
[facets] sees_pole = in_bubble(*points[delaunay.simplices].swapaxes(0, 1), pole) >= 0
[facets] triangles = delaunay.simplices[~sees_pole]  # those of the plane
[facets] sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
[facets] edges, count = np.unique(sides, axis=0, return_counts=True)  # those of the hull are sides of one triangle

size, ball, gap = {size}, {ball}, {gap}  # of each picture, of the ball, between the pictures
left, right = np.array([0.5 * size, 0.5 * size]), np.array([1.5 * size + gap, 0.5 * size])
frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (size / 2 - 1)
projection = Stereographic(-pole, radius=frame.max() / {reach})
shift = frame.max() / {reach} * np.array([{middle}])
flat = np.nan_to_num(projection.forward(points), nan=1e9) - shift  # a site at the pole is far away
lens = fisheye(({focus}), magnification={magnification})
scene, sketch = Scene(limb=LineStyle("#4d4d4d", 1.3)), Sketch()
INK, GRAY, HULL = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#6d8598", 1.3)
RED, WASH, PAPER = LineStyle("#d55e00", 1.8), "#d55e0021", "#fdfcfa"
DOT, HELD = DotStyle("#1b1b1b", 2.5, PAPER, 0.6), DotStyle(RED.color, 3.7, PAPER, 1.0)


def arcs(pairs):
    """Great circles between sites, through the lens."""
    return [lens.image_of(SphereArc.great(points[a], points[b])) for a, b in pairs]


def path(corners):
    return np.linspace(corners, np.roll(corners, -1, axis=0), 4, axis=1)


[hatched facets] along, across = np.arange(-size, size), np.arange(-size, size, 6.0)[:, None]
[hatched facets] steep = np.stack([along - across, along + across], axis=-1) / np.sqrt(2)  # lines, 6 points apart


[hatched facets] def hatch(middle, chosen, lines=steep):
[hatched facets]     """The parts of lines of a picture that are chosen."""
[hatched facets]     row, end = np.nonzero(np.diff(chosen(lines), axis=1, prepend=False, append=False))
[hatched facets]     ends = middle + lines[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[hatched facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[hatched facets] def on_ball(facets, beyond):
[hatched facets]     """Chooses what lies on some facets, and beyond all triangles of the sphere or not."""
[hatched facets]     def chosen(places):
[hatched facets]         axes, found = view.raised(places / ball), np.zeros(places.shape[:2], dtype=bool)
[hatched facets]         seen = np.isfinite(axes[..., 2])
[hatched facets]         found[seen] = np.append(facets, beyond)[delaunay.find_simplex(lens.inverse()(axes[seen] @ view.matrix))]
[hatched facets]         return found
[hatched facets]     return chosen


[seeing facets] hull = PlanarDelaunay(flat[np.unique(triangles)])
[seeing facets] hatch(right, lambda places: hull.find_simplex(places.reshape(-1, 2)).reshape(places.shape[:2]) < 0)
[triangles facets] sketch.add_edges(right + flat, edges, name="delaunay", style=INK)
[triangles facets] scene.add_arcs(arcs(delaunay.edges), name="delaunay", style=INK)
[cells facets] ridges, _ = PlanarVoronoi(flat[np.unique(triangles)]).segments((-size, -size, size, size))
[cells facets] sketch.add_segments(right + ridges, name="voronoi", style=GRAY)
[cells] ridge_arcs = map(lens.image_of, SphericalVoronoi(delaunay).ridge_arcs())
[cells] scene.add_arcs(ridge_arcs, name="voronoi", style=GRAY)
[seeing facets] sketch.add_edges(right + flat, edges[count == 1], name="hull", style=HULL)
[seeing facets] scene.add_arcs(arcs(edges[count == 1]), name="hull", style=HULL)
[bubble aimed] triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(({aim})))]
[bubble aimed] bubble, pairs = SphereCircle.through(*points[triangle]), np.column_stack([triangle, np.roll(triangle, -1)])
[bubble aimed] scene.add_cap(lens.image_of(bubble), name="bubble", color=WASH)
[bubble aimed] scene.add_circles([lens.image_of(bubble)], style=RED)
[bubble aimed] scene.add_arcs(arcs(pairs), name="triangle", style=LineStyle(RED.color, 1.2))
[bubble aimed] image = projection.image_of(bubble)
[bubble aimed] if isinstance(image, PlaneLine):
[bubble aimed]     far = 9 * size * image.direction
[bubble aimed]     sketch.add_segment(right - shift + image.point - far, right - shift + image.point + far, name="circle", style=RED)
[bubble aimed] else:
[bubble aimed]     paths = [path(right - shift + image.sample(720))] + [path(right + frame)] * image.outside
[bubble aimed]     sketch.add_items([Fill(tuple(paths), as_color(WASH), "bubble")])
[bubble aimed]     sketch.add_circle(right - shift + image.center, image.radius, name="circle", style=RED)
[bubble aimed]     if not image.outside:
[bubble aimed]         sketch.add_edges(right + flat, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[step] before, new = SphericalDelaunay(points[: {step} - 1]), {step} - 1
[step] opened = before.simplices[in_bubble(*points[before.simplices].swapaxes(0, 1), points[new]) > 0]
[step] sides = opened[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
[step] fan = np.array([[a, b, new] for a, b in sides if [b, a] not in sides], dtype=int).reshape(-1, 3)
[step] flat_fan = fan[in_bubble(*points[fan].swapaxes(0, 1), pole) < 0]
[step] if len(fan):
[step]     after, ring = dict(fan[:, :2].tolist()), [int(fan[0, 0])]
[step]     while after[ring[-1]] != ring[0]:
[step]         ring.append(after[ring[-1]])
[step]     scene.add_region(arcs(zip(ring, ring[1:] + ring[:1])), name="opened", color=WASH)
[step] for corners in flat_fan:
[step]     sketch.add_polygon(right + flat[corners], name="opened", color=WASH)
[step] planar = planar_part(before, pole)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
[step] scene.add_arcs(arcs(before.edges), name="delaunay", style=INK)
[step] sketch.add_edges(right + flat, np.unique(np.sort(planar, axis=1), axis=0), name="delaunay", style=INK)
[step] scene.add_arcs(arcs(fan[:, [2, 0]]), name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] spokes = np.unique(flat_fan[:, [2, 0, 2, 1]].reshape(-1, 2), axis=0)
[step] sketch.add_edges(right + flat, spokes, name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] scene.add_arcs(arcs(fan[:, :2]), name="horizon", style=RED)
[step] sketch.add_edges(right + flat, flat_fan[:, :2], name="horizon", style=RED)
sketch.add_points((right + flat)[:{count}], name="sites", style=DOT)
scene.add_points(lens(points)[:{count}], name="sites", style=DOT)
[held] sketch.add_points((right + flat)[[{held}]], name="held", style=HELD)
[held] scene.add_points(lens(points)[[{held}]], name="held", style=HELD)
around = Fill((path(right + 9 * frame), path(right + frame)), as_color(PAPER), "paper")
sketch.add_items([around]).add_polyline(right + frame, closed=True, name="frame", style=LineStyle("#4d4d4d", 0.7))
ground, *items = scene.layout(view, at=left, scale=ball)
sketch.add_items([ground])
[seeing facets] hatch(left, on_ball(sees_pole, (sees_pole & delaunay.closing).any()))
[closing hemisphere] for lines in (steep, steep * [1, -1]):
[closing hemisphere]     hatch(left, on_ball(delaunay.closing, True), lines)
sketch.add_items(items)
[pole] at = left + ball * view.project(lens(pole))
[pole front] sketch.add_points(at, name="pole", style=DotStyle(PAPER, 5.9, RED.color, 1.8))
[pole !front] sketch.add_circle(at, 5.0, name="pole", style=LineStyle(RED.color, 1.2))
[pole] sketch.add_label(at, "$P$", (11.0 if at[0] < left[0] else -11.0, 0.0), size=15.0, color="#ab4300")
page = sketch.page((0, 2 * size + gap, 0, size), width=2 * size + gap, background=PAPER)
page.shaded(0.33).save("sphere.svg")
`,Zt=200,ze="cities().lonlat[cities().population >= 2_000_000]",Qt=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${ze})`,en={cities:ze,airports:`airports().lonlat[np.unique(${Qt})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function tn(e,n,t,s,a){let{sites:o,view:r,bubble:l,aim:i,step:c}=e,h=b=>c==="done"&&e.isOn(b),d=[...h("bubble")&&l?.sites||[],...c==="done"?e.held:[c.site]],p={facets:o.facetCount>0,hemisphere:o.hasClosing,step:c!=="done"&&c.insertion!==null,aimed:l!==null,held:d.length>0,pole:t!==null,front:t!==null&&t[2]>=0,hatched:h("seeing")||h("closing")&&o.hasClosing},f={...a,sites:en[s.set]??J(o.lonlat,He(s.file)),pole:x(n.pole),view:x(r.middle),aim:D(i).join(", "),focus:x(D(n.lens.focus)),magnification:n.lens.magnification,held:d.join(", "),step:c==="done"?"":c.site+1,count:c==="done"?"":c.site+1};return K(Jt,f,p,h)}function nn(e,n,t,s){let{sites:a,sheet:o,view:r,isOn:l}=e,[i,c]=[e.p,e.q].filter(y=>y!==null),{contact:h,height:d}=n,p=a.count===0?[3,2]:s,f={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:i!==void 0,pair:c!==void 0&&i!==c,pole:n.seenPole(d)!==null},b={points:J(a.places,`np.loadtxt(${JSON.stringify(t.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${x(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:x(r.middle),width:n.width,height:d,scale:n.scale,contact:`${h[0]}, ${d-h[1]}`,corner:o.corner,pair:[i,c].join(", "),shown:JSON.stringify(n.grounds)};return K(Kt,b,f,l)}function sn(e,n,t,s,a){let{lens:o,sight:r,from:l,to:i,before:c,after:h,pointer:d}=e,{places:p,latitude:f,picture:b,resolution:y}=n,u=o==="bubble",g=p===null||f==="spherical"?"":`, latitude="${f}"`,w=P=>{let T=`(${x(D(P))})`;return g===""?T:`lonlat_to_xyz(${T}${g})`},O=({middle:P,roll:T})=>x([...P,T]).replace(/, -?0$/,""),G={focus:w(r.lens.focus),magnification:x([r.lens.magnification]),taken:`${w(l.center)}, ${x([l.radius])}`,filled:`${w(i.center)}, ${x([i.radius])}`,places:J(p?.lonlat??new Float64Array(0),He(p?.name??"")),latitude:g,picture:JSON.stringify(b?.name??""),resolution:y,step:ue,radius:pe.toFixed(4),pointer:w(d),before:O(c),view:O(u?h:r.view),width:x([1.03*s*(u?2:1)])};return K(Xt,G,{bubble:u,picture:b!==null,places:p!==null,pointed:a},t)}function K(e,n,t,s){let a=c=>t[c]??s(c),r=e.split(`
`).flatMap(c=>{let[,h,d]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(c);return h?.split(" ").every(f=>f.startsWith("!")?!a(f.slice(1)):a(f))===!1?[]:[d]}).join(`
`).replace(/\{(\w+)\}/g,(c,h)=>String(n[h]??c)),l=r.replace(/^(from|import) .*\n/gm,""),i=c=>new RegExp(`\\b${c.split(" as ").pop()}\\b`).test(l);return r.replace(/^((?:from \S+ )?import )(.*)\n/gm,(c,h,d)=>{let p=d.split(", ").filter(i);return p.length===0?"":`${h}${p.join(", ")}
`})}function J(e,n){if(e.length>2*Zt)return n;let t=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=[];for(let a of t){let o=s[s.length-1];o!==void 0&&o.length+a.length<84?s[s.length-1]=`${o} ${a},`:s.push(`    ${a},`)}return s.length===0?"np.zeros((0, 2))":`np.array([
${s.join(`
`)}
])`}function He(e){return`read_points(${JSON.stringify(e)}).lonlat`}function x(e){return e.map(n=>I(n,7)).join(", ")}async function an(e,n){let t=e.cloneNode(!0);t.querySelector("#block-state")?.remove();let s=$("script",{type:"text/plain",id:"block-state"},await on(n));return t.querySelector("#block-kernel").before(s,`
`),new Blob([`<!doctype html>
`,t.outerHTML,`
`],{type:"text/html"})}async function on(e){let n=new Blob([e]).stream().pipeThrough(new CompressionStream("deflate")),t=new Uint8Array(await new Response(n).arrayBuffer());return btoa(Array.from(t,s=>String.fromCharCode(s)).join(""))}function rn(e,n){let t=new Blob([n]),s=$("a",{href:URL.createObjectURL(t),download:e});s.click(),setTimeout(()=>URL.revokeObjectURL(s.href),6e4)}function ln(e){let{title:n,width:t,height:s,weight:a,paint:o}=Ce(e),r=new Fe(t,s,N(),a);return o(r),r.text(n)}function cn(e,n){let{width:t,height:s,weight:a,paint:o}=Ce(e),r=$("canvas",{width:Math.round(t*n),height:Math.round(s*n)}),l=r.getContext("2d");return l.fillStyle=N().paper,l.fillRect(0,0,r.width,r.height),o(new Z(l,t,s,n,N(),a)),new Promise((i,c)=>{r.toBlob(h=>h===null?c(new Error("the picture is too large")):i(h))})}var hn={csv:ft,download:rn,geojson:Et,globePython:sn,legendBlock:Ie,legendWords:Yt,liftPython:nn,openPanorama:jt,openPoints:Oe,savedPage:an,sheetPng:cn,sheetSvg:ln,spherePython:tn};Object.assign(document.currentScript,{offers:hn});})();
